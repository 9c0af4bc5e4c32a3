// SPDX-License-Identifier: MIT
#include "relucent/rehearsal/show_process.h"

#include <sstream>

#include "relucent/base/error.h"
#include "relucent/base/file.h"

namespace relucent::rehearsal {

LogLine logLineFrom(const std::string& line) {
  std::istringstream words(line);
  std::string written, level, mark, time, text;
  words >> written >> level >> mark >> time;
  if (mark != "rehearsal" || !showTimeFrom(time)) return {true, line};
  std::getline(words >> std::ws, text);
  return {level != "info", text};
}

ShowProcess::ShowProcess(const ShowCommand& command) : healthFile_(command.log / "health.json") {
  // That of a show before it says nothing of this one.
  std::error_code error;
  std::filesystem::remove(healthFile_, error);
  std::vector<std::string> arguments{"show"};
  arguments.insert(arguments.end(), command.arguments.begin(), command.arguments.end());
  child_ = platform::ChildProcess::start(command.program.string(), arguments, command.environment, error);
  if (!child_)
    throw Error(ErrorKind::input,
                RELUCENT_ENGLISH_MESSAGE("rehearsal.cannot-start", "the show cannot be started ({})")
                    .with(error.message()),
                RELUCENT_ENGLISH_MESSAGE("rehearsal.name-program",
                                         "name the program relucent with --program: it is looked for beside "
                                         "relucent-cli"),
                command.program.string());
}

void ShowProcess::look() {
  std::error_code code;
  if (std::filesystem::exists(healthFile_, code)) health_ = showHealthFrom(readFile(healthFile_));
}

std::vector<LogLine> ShowProcess::newLines() {
  unfinished_ += child_->errors();
  std::vector<LogLine> lines;
  for (std::size_t end; (end = unfinished_.find('\n')) != std::string::npos; unfinished_.erase(0, end + 1))
    lines.push_back(logLineFrom(unfinished_.substr(0, end)));
  return lines;
}

}  // namespace relucent::rehearsal
