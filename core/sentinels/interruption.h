// SPDX-License-Identifier: MIT
#pragma once

#include <utility>
#include <variant>

namespace relucent::sentinels {

/// Why a measurement does not simply go on after an alarm.
enum class Interruption {
  beginAgain,   // the doubtful shots are forgotten: the measurement begins again
                // and reads the others from its log
  keepAndStop,  // the measurement ends with what was safe before the level under
                // way
};

/// A value, or the interruption that came instead of it.
template <typename Value>
class [[nodiscard]] Interruptible {
 public:
  Interruptible(Value value)  // NOLINT(google-explicit-constructor): a value is
                              // the usual outcome
      : content_(std::move(value)) {}
  Interruptible(Interruption interruption)  // NOLINT(google-explicit-constructor)
      : content_(interruption) {}

  explicit operator bool() const { return std::holds_alternative<Value>(content_); }
  /// Contract: there is a value. Throws: std::bad_variant_access.
  const Value& operator*() const& { return std::get<Value>(content_); }
  Value&& operator*() && { return std::get<Value>(std::move(content_)); }
  const Value* operator->() const { return &std::get<Value>(content_); }
  /// Contract: there is none. Throws: std::bad_variant_access.
  Interruption interruption() const { return std::get<Interruption>(content_); }

 private:
  std::variant<Value, Interruption> content_;
};

}  // namespace relucent::sentinels
