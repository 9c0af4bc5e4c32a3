// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "relucent/platform/child_process.h"
#include "relucent/rehearsal/show_health.h"

namespace relucent::rehearsal {

/// A line of a show's log.
struct LogLine {
  bool isWarning = false;
  std::string text;
};

/// Of "TIME LEVEL rehearsal TIME TEXT", as a rehearsed show writes it; what is written otherwise, by a
/// library or by a program that fails, is a warning.
LogLine logLineFrom(const std::string& line);

/// How a show is started.
struct ShowCommand {
  std::filesystem::path program;
  std::vector<std::string> arguments;    // behind "show"
  std::vector<std::string> environment;  // "NAME=value"
  std::filesystem::path log;             // its folder
};

/// `relucent show` as a process of its own, and what can be seen of it from outside.
class ShowProcess {
 public:
  /// Throws: Error{input} if it cannot be started.
  explicit ShowProcess(const ShowCommand& command);

  /// Looks at its health file. Throws: Error{format} if that is no health file: it is replaced in one step,
  /// so that it always is.
  void look();
  /// As of the last look; none: it has written none yet.
  const std::optional<ShowHealth>& health() const { return health_; }
  /// Lines that it has written since the last call.
  std::vector<LogLine> newLines();

  std::optional<platform::ProcessEnd> ended() { return child_->ended(); }
  std::optional<platform::ProcessUse> use() { return child_->use(); }
  void ask() { child_->ask(); }
  void kill() { child_->kill(); }

 private:
  std::filesystem::path healthFile_;
  std::unique_ptr<platform::ChildProcess> child_;
  std::optional<ShowHealth> health_;
  std::string unfinished_;  // line
};

}  // namespace relucent::rehearsal
