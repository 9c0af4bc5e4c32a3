// SPDX-License-Identifier: MIT
#include "relucent/cli/terminal_progress.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <utility>

#include "relucent/platform/terminal.h"

namespace relucent::cli {

namespace {

/// Two digits say as much as is known.
double rounded(double value) {
  if (value < 10.0) return std::round(value);
  double unit = std::pow(10.0, std::floor(std::log10(value)) - 1.0);
  return unit * std::round(value / unit);
}

}  // namespace

std::string bytesText(std::uint64_t bytes) {
  auto value = static_cast<double>(bytes);
  if (value < 1e9) return fmt::format("{:.0f} MB", std::max(1.0, rounded(value / 1e6)));
  return fmt::format("{:.1f} GB", value / 1e9);
}

std::string workSentence(const WorkLeft& work) {
  return fmt::format(
      "About {:.0f} patterns to photograph ({:.0f} to {:.0f}), {:.0f} photographs: {}{}, {} on disk, {} "
      "of memory",
      rounded(work.shots), rounded(work.leastShots), rounded(work.mostShots), rounded(work.exposures),
      isUnderAMinute(work.seconds) ? "" : "about ", english(expectedDuration(work.seconds)),
      bytesText(work.diskBytes), bytesText(work.memoryBytes));
}

std::string barLine(std::string_view stage, double fraction, std::string_view timeLeft, int width) {
  // The last column stays free: some terminals wrap when it is written.
  auto columns = static_cast<std::size_t>(std::max(width - 1, 0));
  std::string percent = fmt::format("{:3.0f} %", std::floor(100.0 * std::clamp(fraction, 0.0, 1.0)));
  if (columns < percent.size()) return {};

  std::string right = percent;
  if (!timeLeft.empty() && columns >= percent.size() + 2 + timeLeft.size())
    right += fmt::format("  {}", timeLeft);
  std::size_t room = columns - right.size();

  // A bar is worth it from ten cells on; beyond forty it says no more.
  std::string bar;
  std::size_t wanted = stage.size() + 2;
  if (room >= wanted + 10 + 4) {
    std::size_t cells = std::min<std::size_t>(40, room - wanted - 4);
    auto full = static_cast<std::size_t>(static_cast<double>(cells) * std::clamp(fraction, 0.0, 1.0));
    bar = fmt::format("[{}{}]  ", std::string(full, '='), std::string(cells - full, ' '));
    room -= bar.size();
  }
  std::string left;
  if (room >= 2 + 3) left = fmt::format("{}  ", stage.substr(0, room - 2));
  return left + bar + right;
}

TerminalProgress::Terminal TerminalProgress::standardError() {
  return {&std::cerr, platform::errorTerminalWidth, std::chrono::steady_clock::now};
}

TerminalProgress::TerminalProgress(Terminal terminal) : terminal_(std::move(terminal)) {}

TerminalProgress::~TerminalProgress() {
  finish();
}

void TerminalProgress::progressed(double fraction, const Message& stage) {
  constexpr std::chrono::milliseconds betweenDrawings{100};
  const TimeLeft::Moment now = terminal_.now();
  fraction_ = fraction;
  stage_ = english(stage);
  timeLeft_.add(now, fraction);

  int width = terminal_.width();
  if (width == 0) {
    printLine();
  } else if (!drawn_ || now - *drawn_ >= betweenDrawings) {
    drawn_ = now;
    drawBar(width);
  }
}

void TerminalProgress::expected(const WorkLeft& work) {
  timeLeft_.expect(terminal_.now(), work.seconds);
  work_ = work;
  if (!std::exchange(workIsSaid_, true)) say(workSentence(work));
}

void TerminalProgress::say(const std::string& sentence) {
  finish();
  *terminal_.out << sentence << "\n" << std::flush;
}

std::string TerminalProgress::timeLeftSentence() const {
  const std::optional<double> seconds = timeLeft_.seconds(terminal_.now());
  if (!seconds) return {};
  return fmt::format("{}{} left", isUnderAMinute(*seconds) ? "" : "about ",
                     english(expectedDuration(*seconds)));
}

void TerminalProgress::drawBar(int width) {
  *terminal_.out << "\r" << barLine(stage_, fraction_, timeLeftSentence(), width) << "\x1b[K" << std::flush;
  barIsShown_ = true;
}

void TerminalProgress::printLine() {
  bool newStage = stage_ != printedStage_;
  bool further = fraction_ >= printedFraction_ + 0.1;
  if (stage_.empty() || (!newStage && !further)) return;
  std::string timeLeft = timeLeftSentence();
  *terminal_.out << fmt::format("{:3.0f} %  {}{}{}\n", std::floor(100.0 * fraction_), stage_,
                                timeLeft.empty() ? "" : ", ", timeLeft)
                 << std::flush;
  printedStage_ = stage_;
  printedFraction_ = fraction_;
}

void TerminalProgress::finish() {
  if (!barIsShown_) return;
  *terminal_.out << "\r\x1b[K" << std::flush;
  barIsShown_ = false;
}

}  // namespace relucent::cli
