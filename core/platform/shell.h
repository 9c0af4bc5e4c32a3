// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <string>
#include <system_error>

namespace relucent::platform {

/// How a command of the shell ended.
struct ShellResult {
  enum class End {
    notStarted,  // `error` says why
    exited,      // `status` is its exit status
    killed,      // `status` is the number of the signal
    timedOut,    // it was ended from here
  };
  End end = End::notStarted;
  int status = 0;
  std::error_code error{};
  std::string outputTail{};  // the end of what it wrote to both outputs, some kilobytes at most
};

/// Runs `command` through the shell and waits until the shell has ended; what it started in the background
/// goes on. Standard input is empty. After `timeout` the shell and all that it started are ended: asked to
/// first, killed when `grace` is over. Safe to call from any thread.
ShellResult runShell(const std::string& command, std::chrono::milliseconds timeout,
                     std::chrono::milliseconds grace);

}  // namespace relucent::platform
