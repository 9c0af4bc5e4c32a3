// SPDX-License-Identifier: MIT
#include "devices/shell_command.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <filesystem>

#include "base/descriptor.h"
#include "base/error.h"

extern char** environ;

namespace relucent {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

/// Time that a command gets to put its device in order once it was asked to end.
constexpr milliseconds grace{1000};

constexpr std::size_t longestQuote = 300;  // of a command's own words in an error

[[noreturn]] void failStart(int code, const std::string& device) {
  throw Error(ErrorKind::device, fmt::format("the command cannot be started ({})", std::strerror(code)),
              "close other programs and try again", device);
}

/// A nameless file for a command's words. Not a pipe: what the command leaves running in the background may
/// hold it open, and must not die from writing to it, for as long as it likes.
int openTranscript(const std::string& device) {
  std::string name = (std::filesystem::temp_directory_path() / "relucent-XXXXXX").string();
  const int file = ::mkostemp(name.data(), O_CLOEXEC | O_APPEND);
  if (file < 0) failStart(errno, device);
  ::unlink(name.c_str());
  return file;
}

/// The last line with anything in it, shortened.
std::string lastLineOf(int transcript) {
  std::array<char, 4096> tail{};
  const off_t end = ::lseek(transcript, 0, SEEK_END);
  const off_t begin = std::max<off_t>(0, end - static_cast<off_t>(tail.size()));
  const ssize_t count = ::pread(transcript, tail.data(), tail.size(), begin);
  std::string text(tail.data(), static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
  text.erase(text.find_last_not_of(" \t\r\n") + 1);
  std::string line = text.substr(text.find_last_of("\r\n") + 1);
  if (line.size() > longestQuote) line = line.substr(0, longestQuote) + "...";
  return line;
}

/// What posix_spawn needs to know; both parts free themselves.
struct SpawnPlan {
  posix_spawn_file_actions_t files;
  posix_spawnattr_t attributes;
  SpawnPlan() {
    posix_spawn_file_actions_init(&files);
    posix_spawnattr_init(&attributes);
  }
  ~SpawnPlan() {
    posix_spawn_file_actions_destroy(&files);
    posix_spawnattr_destroy(&attributes);
  }
  SpawnPlan(const SpawnPlan&) = delete;
  SpawnPlan& operator=(const SpawnPlan&) = delete;
};

/// Starts the shell as the leader of a process group of its own, with default signal handling.
pid_t spawnShell(const std::string& command, int transcript, const std::string& device) {
  SpawnPlan plan;
  posix_spawn_file_actions_addopen(&plan.files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&plan.files, transcript, STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&plan.files, transcript, STDERR_FILENO);

  sigset_t none, usual;
  sigemptyset(&none);
  sigemptyset(&usual);
  for (int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE, SIGQUIT}) sigaddset(&usual, signal);
  posix_spawnattr_setsigmask(&plan.attributes, &none);
  posix_spawnattr_setsigdefault(&plan.attributes, &usual);
  posix_spawnattr_setpgroup(&plan.attributes, 0);
  posix_spawnattr_setflags(&plan.attributes,
                           POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);

  std::string shell = "sh", option = "-c", text = command;
  std::array<char*, 4> arguments{shell.data(), option.data(), text.data(), nullptr};
  pid_t process = 0;
  const int code = posix_spawn(&process, "/bin/sh", &plan.files, &plan.attributes, arguments.data(), environ);
  if (code != 0) failStart(code, device);
  return process;
}

/// True once `process` has ended, false if that takes longer than `time`.
bool endsWithin(int process, milliseconds time) {
  const Clock::time_point deadline = Clock::now() + time;
  pollfd wait{process, POLLIN, 0};
  for (;;) {
    const auto left = std::chrono::ceil<milliseconds>(deadline - Clock::now()).count();
    const int ready = ::poll(&wait, 1, static_cast<int>(std::clamp<std::int64_t>(left, 0, 1 << 30)));
    if (ready > 0) return true;
    if (ready == 0 && Clock::now() >= deadline) return false;
    if (ready < 0 && errno != EINTR) return false;
  }
}

std::string saying(const std::string& lastLine) {
  return lastLine.empty() ? "" : fmt::format(", saying \"{}\"", lastLine);
}

void checkStatus(int status, const std::string& command, const std::string& lastLine,
                 const std::string& device) {
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return;
  const std::string end = WIFEXITED(status) ? fmt::format("failed with status {}", WEXITSTATUS(status))
                                            : fmt::format("was killed by signal {}", WTERMSIG(status));
  throw Error(ErrorKind::device, fmt::format("the command {}{}", end, saying(lastLine)),
              fmt::format("run it in a terminal to find out why: {}", command), device);
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
  const Descriptor transcript(openTranscript(device));
  const pid_t process = spawnShell(command, transcript.get(), device);
  const Descriptor handle(static_cast<int>(::syscall(SYS_pidfd_open, process, 0)));
  const int openCode = errno;

  const bool ended = handle.ok() && endsWithin(handle.get(), timeout);
  if (!ended) {
    ::kill(-process, SIGTERM);
    if (handle.ok()) endsWithin(handle.get(), grace);
    // The shell is not waited for yet, so its group's number cannot belong to anybody else.
    ::kill(-process, SIGKILL);
  }
  int status = 0;
  while (::waitpid(process, &status, 0) < 0 && errno == EINTR) {
  }

  if (!handle.ok()) failStart(openCode, device);
  const std::string lastLine = lastLineOf(transcript.get());
  if (!ended)
    throw Error(ErrorKind::device,
                fmt::format("the command took longer than {:.3g} s{}",
                            std::chrono::duration<double>(timeout).count(), saying(lastLine)),
                fmt::format("check the device, or allow the command more time: {}", command), device);
  checkStatus(status, command, lastLine, device);
}

}  // namespace relucent
