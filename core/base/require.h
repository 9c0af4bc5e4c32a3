// SPDX-License-Identifier: MIT
#pragma once

#include <fmt/format.h>

#include <source_location>
#include <stdexcept>
#include <string>
#include <string_view>

namespace relucent {

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
/// Throws: std::logic_error with the values and the place, if `condition` is false.
template <typename... Args>
void require(bool condition, const detail::RequireMessage& message, const Args&... args) {
  if (condition) [[likely]]
    return;
  detail::failRequire(message.location, fmt::format(fmt::runtime(message.format), args...));
}

}  // namespace relucent
