// SPDX-License-Identifier: MIT
#include "relucent/platform/child_process.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <string_view>
#include <utility>

#include "relucent/platform/descriptor.h"
#include "relucent/platform/spawn_plan.h"

extern char** environ;

namespace relucent::platform {
namespace {

/// This program's, with what replaces it.
std::vector<std::string> mergedEnvironment(const std::vector<std::string>& wanted) {
  const auto nameOf = [](std::string_view setting) { return setting.substr(0, setting.find('=')); };
  std::vector<std::string> merged = wanted;
  for (char** own = environ; *own != nullptr; ++own)
    if (std::ranges::none_of(wanted, [&](const std::string& one) { return nameOf(one) == nameOf(*own); }))
      merged.emplace_back(*own);
  return merged;
}

std::vector<char*> pointersTo(std::vector<std::string>& texts) {
  std::vector<char*> pointers;
  for (std::string& text : texts) pointers.push_back(text.data());
  pointers.push_back(nullptr);
  return pointers;
}

std::pair<pid_t, int> spawn(const std::string& program, const std::vector<std::string>& arguments,
                            const std::vector<std::string>& environment, int errors) {
  SpawnPlan plan;
  posix_spawn_file_actions_addopen(&plan.files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&plan.files, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_adddup2(&plan.files, errors, STDERR_FILENO);
  std::vector<std::string> words{program}, settings = mergedEnvironment(environment);
  words.insert(words.end(), arguments.begin(), arguments.end());
  pid_t process = 0;
  const int code = posix_spawn(&process, program.c_str(), &plan.files, &plan.attributes,
                               pointersTo(words).data(), pointersTo(settings).data());
  return {process, code};
}

/// The number in a line "NAME:   123 kB" of a process's status.
std::uint64_t numberIn(std::string_view line) {
  const std::size_t begin = line.find_first_of("0123456789");
  std::uint64_t number = 0;
  if (begin != std::string_view::npos)
    std::from_chars(line.data() + begin, line.data() + line.size(), number);
  return number;
}

}  // namespace

std::filesystem::path ownProgram() {
  std::error_code code;
  return std::filesystem::read_symlink("/proc/self/exe", code);
}

class ChildProcess::Impl {
 public:
  Impl(pid_t process, int errors) : process_(process), errors_(errors) {}
  ~Impl() {
    send(SIGKILL);
    wait(0);
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  std::optional<ProcessEnd> wait(int how) {
    int status = 0;
    pid_t found = 0;
    while (!end_ && (found = ::waitpid(process_, &status, how)) < 0 && errno == EINTR) {
    }
    if (found == process_)
      end_ = WIFEXITED(status) ? ProcessEnd{false, WEXITSTATUS(status)} : ProcessEnd{true, WTERMSIG(status)};
    return end_;
  }
  void send(int signal) const {
    if (!end_) ::kill(process_, signal);  // not waited for yet, so that its number is nobody else's
  }
  std::string read() const {
    std::string all;
    std::array<char, 4096> bytes{};
    for (ssize_t count; (count = ::read(errors_.get(), bytes.data(), bytes.size())) > 0;)
      all.append(bytes.data(), static_cast<std::size_t>(count));
    return all;
  }
  std::filesystem::path facts() const { return "/proc/" + std::to_string(process_); }

 private:
  pid_t process_;
  Descriptor errors_;
  std::optional<ProcessEnd> end_;
};

ChildProcess::ChildProcess(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
ChildProcess::~ChildProcess() = default;

std::unique_ptr<ChildProcess> ChildProcess::start(const std::string& program,
                                                  const std::vector<std::string>& arguments,
                                                  const std::vector<std::string>& environment,
                                                  std::error_code& error) {
  std::array<int, 2> pipe{};
  if (::pipe2(pipe.data(), O_CLOEXEC) != 0) {
    error = lastError();
    return nullptr;
  }
  const Descriptor written(pipe[1]);
  ::fcntl(pipe[0], F_SETFL, O_NONBLOCK);
  const auto [process, code] = spawn(program, arguments, environment, written.get());
  if (code != 0) {
    ::close(pipe[0]);
    error = {code, std::generic_category()};
    return nullptr;
  }
  return std::unique_ptr<ChildProcess>(new ChildProcess(std::make_unique<Impl>(process, pipe[0])));
}

std::optional<ProcessEnd> ChildProcess::ended() {
  return impl_->wait(WNOHANG);
}

void ChildProcess::ask() {
  impl_->send(SIGTERM);
}

void ChildProcess::kill() {
  impl_->send(SIGKILL);
  impl_->wait(0);
}

std::string ChildProcess::errors() {
  return impl_->read();
}

std::optional<ProcessUse> ChildProcess::use() {
  if (ended()) return std::nullopt;
  ProcessUse use;
  std::ifstream status(impl_->facts() / "status");
  for (std::string line; std::getline(status, line);) {
    if (line.starts_with("VmRSS:")) use.residentBytes = 1024 * numberIn(line);
    if (line.starts_with("RssAnon:")) use.ownBytes = 1024 * numberIn(line);
    if (line.starts_with("Threads:")) use.threads = static_cast<int>(numberIn(line));
  }
  std::error_code code;
  for (std::filesystem::directory_iterator one(impl_->facts() / "fd", code), end; !code && one != end;
       one.increment(code))
    ++use.handles;
  return use;
}

}  // namespace relucent::platform
