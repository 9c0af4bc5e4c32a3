// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <deque>
#include <functional>
#include <ostream>
#include <string>

#include "relucent/base/progress.h"

namespace relucent::cli {

/// How much longer, from how fast it went lately: the mean rate of the last half minute, because a stage
/// that is read from a journal or a cache says nothing about the next one.
class TimeLeft {
 public:
  using Seconds = std::chrono::duration<double>;

  void add(Seconds now, double fraction);
  /// What somebody who knows the work expects; believed until it has passed.
  void expect(Seconds now, Seconds left);
  /// Below zero: not known yet.
  Seconds left() const;
  /// "about 3 min left", rounded up; empty while it is not known.
  std::string sentence() const;

 private:
  struct Sample {
    Seconds time;
    double fraction;
  };
  std::deque<Sample> samples_;
  Seconds expectedEnd_{-1.0};
};

/// Progress on a terminal as one line that is redrawn at most ten times a second; elsewhere (a log, a pipe)
/// as a plain line at each new stage and every ten percent.
class TerminalProgress : public ProgressSink {
 public:
  /// What it writes to and how that looks; injected, so that tests need no terminal.
  struct Terminal {
    std::ostream* out = nullptr;
    /// Columns; 0: not a terminal.
    std::function<int()> width;
    std::function<std::chrono::duration<double>()> now;
  };
  /// Standard error of this program.
  static Terminal standardError();

  explicit TerminalProgress(Terminal terminal);
  ~TerminalProgress() override;

  void progressed(double fraction, const Message& stage) override;
  /// Says so in a line of its own the first time; after that the time left follows it.
  void expected(const WorkLeft& work) override;
  /// Takes the bar away, so that a sentence can be printed in its place. Called by the destructor too.
  void finish();

 private:
  void drawBar(int width);
  void printLine();

  Terminal terminal_;
  TimeLeft timeLeft_;
  double fraction_ = 0.0;
  std::string stage_;
  std::chrono::duration<double> drawn_{-1.0};
  bool barIsShown_ = false;
  bool workIsSaid_ = false;
  std::string printedStage_;
  double printedFraction_ = -1.0;
};

/// "About 2100 patterns to photograph (430 to 4300), 4200 photographs, ..."
std::string workSentence(const WorkLeft& work);

/// A bar's line: stage, bar, percent, time left, in at most `width` - 1 columns; parts that do not fit are
/// left out, the percentage last.
std::string barLine(std::string_view stage, double fraction, std::string_view timeLeft, int width);

}  // namespace relucent::cli
