// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <optional>
#include <ostream>
#include <string>

#include "relucent/base/progress.h"
#include "relucent/base/time_left.h"

namespace relucent::cli {

/// Progress on a terminal as one line that is redrawn at most ten times a second; elsewhere (a log, a pipe)
/// as a plain line at each new stage and every ten percent.
class TerminalProgress : public ProgressSink {
 public:
  /// What it writes to and how that looks; injected, so that tests need no terminal.
  struct Terminal {
    std::ostream* out = nullptr;
    /// Columns; 0: not a terminal.
    std::function<int()> width;
    std::function<TimeLeft::Moment()> now;
  };
  /// Standard error of this program.
  static Terminal standardError();

  explicit TerminalProgress(Terminal terminal);
  ~TerminalProgress() override;

  void progressed(double fraction, const Message& stage) override;
  /// Says so in a line of its own the first time; after that the time left follows it.
  void expected(const WorkLeft& work) override;
  /// What was expected last.
  const WorkLeft& workLeft() const { return work_; }
  /// A sentence on a line of its own.
  void say(const std::string& sentence);
  /// Nothing is done until resume(): the time left stands still.
  void pause() { timeLeft_.pause(terminal_.now()); }
  void resume() { timeLeft_.resume(terminal_.now()); }
  /// Takes the bar away, so that a sentence can be printed in its place. Called by the destructor too.
  void finish();

 private:
  /// "about 3 min left"; empty while it is not known.
  std::string timeLeftSentence() const;
  void drawBar(int width);
  void printLine();

  Terminal terminal_;
  TimeLeft timeLeft_;
  double fraction_ = 0.0;
  std::string stage_;
  std::optional<TimeLeft::Moment> drawn_;
  bool barIsShown_ = false;
  bool workIsSaid_ = false;
  WorkLeft work_;
  std::string printedStage_;
  double printedFraction_ = -1.0;
};

/// "490 MB", "2.1 GB": two digits below a GB, at least 1 MB.
std::string bytesText(std::uint64_t bytes);

/// "About 2100 patterns to photograph (430 to 4300), 4200 photographs, ..."
std::string workSentence(const WorkLeft& work);

/// A bar's line: stage, bar, percent, time left, in at most `width` - 1 columns; parts that do not fit are
/// left out, the percentage last.
std::string barLine(std::string_view stage, double fraction, std::string_view timeLeft, int width);

}  // namespace relucent::cli
