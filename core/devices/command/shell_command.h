// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <map>
#include <string>
#include <string_view>
#include <utility>

#include "relucent/base/error.h"

namespace relucent::devices {

/// `text` as one word of a shell command: as it is if it holds nothing special, else in single quotes.
std::string shellQuoted(std::string_view text);

/// `command` with every {name} replaced by its value, quoted for the shell. Other braces stay as they are.
std::string substituted(std::string_view command, const std::map<std::string, std::string>& values);

/// A command that could not be started, took too long, was killed or failed. The advice names it.
class CommandFailed : public Error {
 public:
  CommandFailed(Message what, Message advice, std::string device)
      : Error(ErrorKind::device, std::move(what), std::move(advice), std::move(device)) {}
};

/// Runs `command` through /bin/sh and waits until the shell has ended; what it started in the background goes
/// on. Standard input is empty; both outputs are kept for the error message only.
/// After `timeout` the shell and all that it started are ended: asked to first, then killed.
/// `device` names the device in errors. Safe to call from any thread.
/// Throws: CommandFailed if it cannot be started, takes too long, is killed, or its exit status is not 0,
/// with the last line that it wrote.
void runShellCommand(const std::string& command, std::chrono::milliseconds timeout,
                     const std::string& device);

}  // namespace relucent::devices
