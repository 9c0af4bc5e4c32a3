// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace relucent {

/// A 128-bit fingerprint of data, to decide whether a result still belongs to its inputs. Not for security.
/// Everything added is preceded by its length, so ("ab", "c") and ("a", "bc") differ.
class Fingerprint {
 public:
  Fingerprint();
  ~Fingerprint();
  Fingerprint(const Fingerprint&) = delete;
  Fingerprint& operator=(const Fingerprint&) = delete;

  Fingerprint& addBytes(const void* data, std::size_t bytes);
  Fingerprint& add(std::string_view text) { return addBytes(text.data(), text.size()); }
  template <typename Number>
    requires std::is_arithmetic_v<Number>
  Fingerprint& add(Number value) {
    return addBytes(&value, sizeof(value));
  }
  template <typename Number>
    requires std::is_arithmetic_v<Number>
  Fingerprint& add(const std::vector<Number>& values) {
    return addBytes(values.data(), values.size() * sizeof(Number));
  }

  /// 32 hexadecimal digits.
  std::string hex() const;
  /// The low 64 bits, as a key for Random.
  std::uint64_t low() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace relucent
