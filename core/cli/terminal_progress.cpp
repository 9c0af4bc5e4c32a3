// SPDX-License-Identifier: MIT
#include "relucent/cli/terminal_progress.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iostream>

#include "relucent/platform/terminal.h"

namespace relucent::cli {

using Seconds = TimeLeft::Seconds;

void TimeLeft::add(Seconds now, double fraction) {
  constexpr Seconds apart{1.0};
  constexpr Seconds window{30.0};
  // Between two samples only the newest moves, so that there are never more than a few dozen.
  if (samples_.size() >= 2 && now - samples_[samples_.size() - 2].time < apart)
    samples_.back() = {now, fraction};
  else
    samples_.push_back({now, fraction});
  while (samples_.size() > 2 && now - samples_[1].time >= window) samples_.pop_front();
}

void TimeLeft::expect(Seconds now, Seconds left) {
  expectedEnd_ = now + left;
}

Seconds TimeLeft::left() const {
  constexpr Seconds leastTime{3.0};
  if (samples_.empty()) return Seconds{-1.0};
  if (expectedEnd_ > samples_.back().time) return expectedEnd_ - samples_.back().time;
  Seconds time = samples_.back().time - samples_.front().time;
  double share = samples_.back().fraction - samples_.front().fraction;
  if (time < leastTime || share <= 0.0) return Seconds{-1.0};
  return time * ((1.0 - samples_.back().fraction) / share);
}

namespace {

/// Rounded up: 10 s below a minute, whole minutes above.
std::string timeOf(double seconds) {
  if (seconds <= 50.0) return fmt::format("{:.0f} s", std::max(10.0, 10.0 * std::ceil(seconds / 10.0)));
  double minutes = std::ceil(seconds / 60.0);
  if (minutes < 60.0) return fmt::format("{:.0f} min", minutes);
  return fmt::format("{:.0f} h {:02.0f} min", std::floor(minutes / 60.0), std::fmod(minutes, 60.0));
}

/// Two digits say as much as is known.
double rounded(double value) {
  if (value < 10.0) return std::round(value);
  double unit = std::pow(10.0, std::floor(std::log10(value)) - 1.0);
  return unit * std::round(value / unit);
}

std::string bytesOf(std::uint64_t bytes) {
  auto value = static_cast<double>(bytes);
  if (value < 1e9) return fmt::format("{:.0f} MB", std::max(1.0, rounded(value / 1e6)));
  return fmt::format("{:.1f} GB", value / 1e9);
}

}  // namespace

std::string TimeLeft::sentence() const {
  double seconds = left().count();
  return seconds < 0.0 ? std::string() : fmt::format("about {} left", timeOf(seconds));
}

std::string workSentence(const WorkLeft& work) {
  return fmt::format(
      "About {:.0f} patterns to photograph ({:.0f} to {:.0f}), {:.0f} photographs: about {}, {} on disk, {} "
      "of "
      "memory",
      rounded(work.shots), rounded(work.leastShots), rounded(work.mostShots), rounded(work.exposures),
      timeOf(work.seconds), bytesOf(work.diskBytes), bytesOf(work.memoryBytes));
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
  auto now = [] { return Seconds(std::chrono::steady_clock::now().time_since_epoch()); };
  return {&std::cerr, platform::errorTerminalWidth, now};
}

TerminalProgress::TerminalProgress(Terminal terminal) : terminal_(std::move(terminal)) {}

TerminalProgress::~TerminalProgress() {
  finish();
}

void TerminalProgress::progressed(double fraction, const Message& stage) {
  constexpr Seconds betweenDrawings{0.1};
  Seconds now = terminal_.now();
  fraction_ = fraction;
  stage_ = english(stage);
  timeLeft_.add(now, fraction);

  int width = terminal_.width();
  if (width == 0) {
    printLine();
  } else if (drawn_.count() < 0.0 || now - drawn_ >= betweenDrawings) {
    drawn_ = now;
    drawBar(width);
  }
}

void TerminalProgress::expected(const WorkLeft& work) {
  timeLeft_.expect(terminal_.now(), Seconds{work.seconds});
  if (workIsSaid_) return;
  workIsSaid_ = true;
  finish();
  *terminal_.out << workSentence(work) << "\n" << std::flush;
}

void TerminalProgress::drawBar(int width) {
  *terminal_.out << "\r" << barLine(stage_, fraction_, timeLeft_.sentence(), width) << "\x1b[K" << std::flush;
  barIsShown_ = true;
}

void TerminalProgress::printLine() {
  bool newStage = stage_ != printedStage_;
  bool further = fraction_ >= printedFraction_ + 0.1;
  if (stage_.empty() || (!newStage && !further)) return;
  std::string timeLeft = timeLeft_.sentence();
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
