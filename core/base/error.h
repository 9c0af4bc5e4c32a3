// SPDX-License-Identifier: MIT
#pragma once

#include <exception>
#include <string>
#include <string_view>

#include "relucent/base/message.h"
#include "relucent/base/require.h"  // IWYU pragma: export: whoever reports failures also checks contracts

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

}  // namespace relucent
