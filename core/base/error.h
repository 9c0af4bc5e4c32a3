// SPDX-License-Identifier: MIT
#pragma once

#include <fmt/format.h>

#include <source_location>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>

#include "base/message.h"

namespace relucent {

/// Kind of failure that an Error reports; decides icon and exit status, never control flow.
enum class ErrorKind { usage, input, format, disk, memory, device, numerics };

std::string_view toString(ErrorKind kind);

/// A failure outside the program: a file, a device, a setting, data that cannot be used. `what` is one
/// sentence without a full stop that says what is wrong, `advice` one that says what to do, possibly none,
/// `context` where it happened (a file, a device, a stage), possibly empty.
/// A broken contract is not an Error: see require().
class Error : public std::exception {
 public:
  Error(ErrorKind kind, Message what, Message advice, std::string context = {});

  ErrorKind kind() const { return kind_; }
  const Message& summary() const { return what_; }
  const Message& advice() const { return advice_; }
  const std::string& context() const { return context_; }

  /// All of it in one sentence: "context: what; advice".
  Message sentence() const;
  /// The same in English, with a full stop.
  const char* what() const noexcept override { return line_.c_str(); }

  /// The same failure with an outer context; an existing context follows the new one.
  Error within(std::string_view context) const;

 private:
  ErrorKind kind_;
  Message what_;
  Message advice_;
  std::string context_;
  std::string line_;
};

namespace detail {
/// A format string that remembers where require() was called.
struct RequireMessage {
  template <typename Text>
  RequireMessage(const Text& text, std::source_location where = std::source_location::current())  // NOLINT
      : format(text), location(where) {}
  std::string_view format;
  std::source_location location;
};
[[noreturn]] void failRequire(const std::source_location& location, const std::string& message);
}  // namespace detail

/// Checks a contract: `require(a == b, "{} rows must equal {} pixels", a, b)`.
/// Throws: std::logic_error with the values and the source location if `condition` is false.
template <typename... Args>
void require(bool condition, const detail::RequireMessage& message, const Args&... args) {
  if (condition) [[likely]]
    return;
  detail::failRequire(message.location, fmt::format(fmt::runtime(message.format), args...));
}

}  // namespace relucent
