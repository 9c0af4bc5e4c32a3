// SPDX-License-Identifier: MIT
#include "output/show_log.h"

#include <spdlog/logger.h>
#include <spdlog/sinks/rotating_file_sink.h>
#include <spdlog/sinks/stdout_sinks.h>

#include <QDir>
#include <utility>
#include <vector>

#include "relucent/base/error.h"
#include "relucent/base/terminal_text.h"

namespace relucent::gui {
namespace {

constexpr std::size_t largest = std::size_t{1} << 20;
constexpr std::size_t older = 4;

}  // namespace

ShowLog::ShowLog(const QString& folder, Mark mark) : mark_(std::move(mark)) {
  std::string file = QDir(folder).filePath("show.log").toStdString();
  try {
    QDir().mkpath(folder);
    std::vector<spdlog::sink_ptr> sinks{
        std::make_shared<spdlog::sinks::rotating_file_sink_mt>(file, largest, older),
        std::make_shared<spdlog::sinks::stderr_sink_mt>()};
    logger_ = std::make_shared<spdlog::logger>("show", sinks.begin(), sinks.end());
  } catch (const spdlog::spdlog_ex& error) {
    throw Error(
        ErrorKind::disk,
        RELUCENT_MESSAGE("show.cannot-write-log", "the log cannot be written ({})").with(error.what()),
        RELUCENT_MESSAGE("show.choose-another-log-folder", "choose another folder with --log"), file);
  }
  logger_->set_pattern("%Y-%m-%dT%H:%M:%S%z %l %v");
  // A log that stops at a power cut should hold what led to it.
  logger_->flush_on(spdlog::level::info);
}

ShowLog::~ShowLog() = default;

std::string ShowLog::lineOf(const QString& sentence) const {
  return forLogLine((mark_() + sentence).toStdString());
}

void ShowLog::tell(const QString& sentence) {
  logger_->info(lineOf(sentence));
}

void ShowLog::warn(const QString& sentence) {
  logger_->warn(lineOf(sentence));
}

}  // namespace relucent::gui
