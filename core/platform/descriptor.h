// SPDX-License-Identifier: MIT
#pragma once

#include <unistd.h>

#include <cerrno>
#include <system_error>

namespace relucent::platform {

/// What the last call of the system failed with.
inline std::error_code lastError() {
  return {errno, std::generic_category()};
}

/// An open file descriptor of POSIX that closes itself. Negative: there is none, and errno of who tried to
/// open it says why. For this folder alone.
class Descriptor {
 public:
  explicit Descriptor(int value) : value_(value) {}
  ~Descriptor() {
    if (value_ >= 0) ::close(value_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  int get() const { return value_; }
  bool ok() const { return value_ >= 0; }

 private:
  int value_;
};

}  // namespace relucent::platform
