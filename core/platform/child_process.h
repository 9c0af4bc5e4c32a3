// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

namespace relucent::platform {

/// The file of the program that runs; empty where the system does not tell.
std::filesystem::path ownProgram();

/// How a program ended.
struct ProcessEnd {
  bool killed = false;  // by a signal
  int status = 0;       // its exit status, or the signal's number
};

/// What a running program takes.
struct ProcessUse {
  std::uint64_t residentBytes = 0;
  std::uint64_t ownBytes = 0;  // of these, what belongs to no file: heaps and stacks
  int handles = 0;             // open files, sockets and the like
  int threads = 0;
};

/// Another program that runs beside this one, in a process group of its own. Its standard input is empty, its
/// standard output goes nowhere. For one thread.
class ChildProcess {
 public:
  /// `environment`: "NAME=value", beside and in place of this program's own. nullptr where it cannot be
  /// started: `error` says why.
  static std::unique_ptr<ChildProcess> start(const std::string& program,
                                             const std::vector<std::string>& arguments,
                                             const std::vector<std::string>& environment,
                                             std::error_code& error);
  /// Kills it if it still runs.
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  /// None: it runs.
  std::optional<ProcessEnd> ended();
  /// Asks it to end, by the signal for it.
  void ask();
  /// Ends it at once, as a power failure does. Returns when it is gone.
  void kill();
  /// What it wrote to standard error since the last call; does not wait. A program that writes more than a
  /// pipe holds waits until it is read.
  std::string errors();
  /// None: it has ended.
  std::optional<ProcessUse> use();

 private:
  class Impl;
  explicit ChildProcess(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace relucent::platform
