// SPDX-License-Identifier: MIT
#include "relucent/platform/shell.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <filesystem>
#include <utility>

#include "relucent/platform/descriptor.h"
#include "relucent/platform/spawn_plan.h"

extern char** environ;

namespace relucent::platform {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;
using End = ShellResult::End;

ShellResult notStarted(int code) {
  return {End::notStarted, 0, {code, std::generic_category()}};
}

/// A nameless file for a command's output. Not a pipe: what the command leaves running in the background may
/// hold it open, and must not die from writing to it, for as long as it likes.
int openTranscript() {
  std::string name = (std::filesystem::temp_directory_path() / "relucent-XXXXXX").string();
  const int file = ::mkostemp(name.data(), O_CLOEXEC | O_APPEND);
  if (file >= 0) ::unlink(name.c_str());
  return file;
}

std::string tailOf(int transcript) {
  std::array<char, 4096> tail{};
  const off_t end = ::lseek(transcript, 0, SEEK_END);
  const off_t begin = std::max<off_t>(0, end - static_cast<off_t>(tail.size()));
  const ssize_t count = ::pread(transcript, tail.data(), tail.size(), begin);
  return {tail.data(), static_cast<std::size_t>(std::max<ssize_t>(count, 0))};
}

/// Starts the shell as the leader of a process group of its own, with default signal handling. Gives the
/// process and the system's error.
std::pair<pid_t, int> spawnShell(const std::string& command, int transcript) {
  SpawnPlan plan;
  posix_spawn_file_actions_addopen(&plan.files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&plan.files, transcript, STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&plan.files, transcript, STDERR_FILENO);

  std::string shell = "sh", option = "-c", text = command;
  std::array<char*, 4> arguments{shell.data(), option.data(), text.data(), nullptr};
  pid_t process = 0;
  const int code = posix_spawn(&process, "/bin/sh", &plan.files, &plan.attributes, arguments.data(), environ);
  return {process, code};
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

}  // namespace

ShellResult runShell(const std::string& command, milliseconds timeout, milliseconds grace) {
  const Descriptor transcript(openTranscript());
  if (!transcript.ok()) return notStarted(errno);
  const auto [process, code] = spawnShell(command, transcript.get());
  if (code != 0) return notStarted(code);
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

  if (!handle.ok()) return notStarted(openCode);
  ShellResult result;
  result.outputTail = tailOf(transcript.get());
  result.end = !ended ? End::timedOut : WIFEXITED(status) ? End::exited : End::killed;
  result.status = WIFEXITED(status) ? WEXITSTATUS(status) : WTERMSIG(status);
  return result;
}

}  // namespace relucent::platform
