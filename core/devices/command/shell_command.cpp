// SPDX-License-Identifier: MIT
#include "relucent/devices/command/shell_command.h"

#include <fmt/format.h>

#include <algorithm>

#include "relucent/platform/shell.h"

namespace relucent::devices {
namespace {

using std::chrono::milliseconds;
using End = platform::ShellResult::End;

/// Time that a command gets to put its device in order once it was asked to end.
constexpr milliseconds grace{1000};

constexpr std::size_t longestQuote = 300;  // of a command's own words in an error

/// The last line with anything in it, shortened.
std::string lastLineOf(std::string text) {
  text.erase(text.find_last_not_of(" \t\r\n") + 1);
  std::string line = text.substr(text.find_last_of("\r\n") + 1);
  if (line.size() > longestQuote) line = line.substr(0, longestQuote) + "...";
  return line;
}

Message endOf(const platform::ShellResult& result, milliseconds timeout, const std::string& lastLine) {
  const Argument time = as::seconds(std::chrono::duration<double>(timeout).count(), as::digits(3));
  const Argument status = as::label(result.status);
  const bool silent = lastLine.empty();
  if (result.end == End::timedOut)
    return silent
               ? RELUCENT_MESSAGE("device.command-too-long", "the command took longer than {} s").with(time)
               : RELUCENT_MESSAGE("device.command-too-long-saying",
                                  "the command took longer than {} s, saying \"{}\"")
                     .with(time, lastLine);
  if (result.end == End::exited)
    return silent
               ? RELUCENT_MESSAGE("device.command-failed", "the command failed with status {}").with(status)
               : RELUCENT_MESSAGE("device.command-failed-saying",
                                  "the command failed with status {}, saying \"{}\"")
                     .with(status, lastLine);
  return silent
             ? RELUCENT_MESSAGE("device.command-killed", "the command was killed by signal {}").with(status)
             : RELUCENT_MESSAGE("device.command-killed-saying",
                                "the command was killed by signal {}, saying \"{}\"")
                   .with(status, lastLine);
}

}  // namespace

std::string shellQuoted(std::string_view text) {
  constexpr std::string_view plain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./:=+,@%";
  if (!text.empty() && text.find_first_not_of(plain) == std::string_view::npos) return std::string(text);
  std::string quoted = "'";
  for (char letter : text) quoted += letter == '\'' ? std::string("'\\''") : std::string(1, letter);
  return quoted + "'";
}

std::string substituted(std::string_view command, const std::map<std::string, std::string>& values) {
  std::string result;
  while (!command.empty()) {
    const std::size_t open = std::min(command.find('{'), command.size());
    result += command.substr(0, open);
    command.remove_prefix(open);
    const std::size_t close = command.find('}');
    const auto value = close == std::string_view::npos
                           ? values.end()
                           : values.find(std::string(command.substr(1, close - 1)));
    const bool known = value != values.end();
    result += known ? shellQuoted(value->second) : std::string(command.substr(0, 1));
    command.remove_prefix(known ? close + 1 : std::min<std::size_t>(1, command.size()));
  }
  return result;
}

void runShellCommand(const std::string& command, milliseconds timeout, const std::string& device) {
  const platform::ShellResult result = platform::runShell(command, timeout, grace);
  if (result.end == End::exited && result.status == 0) return;
  if (result.end == End::notStarted)
    throw Error(ErrorKind::device,
                RELUCENT_MESSAGE("device.cannot-start-command", "the command cannot be started ({})")
                    .with(result.error.message()),
                RELUCENT_MESSAGE("device.close-other-programs", "close other programs and try again"),
                device);
  const std::string lastLine = lastLineOf(result.outputTail);
  if (result.end == End::timedOut)
    throw CommandFailed(endOf(result, timeout, lastLine),
                        RELUCENT_MESSAGE("device.allow-command-more-time",
                                         "check the device, or allow the command more time: {}")
                            .with(command),
                        device);
  throw CommandFailed(
      endOf(result, timeout, lastLine),
      RELUCENT_MESSAGE("device.run-command-in-terminal", "run it in a terminal to find out why: {}")
          .with(command),
      device);
}

}  // namespace relucent::devices
