// SPDX-License-Identifier: MIT
#pragma once

#include <QDir>
#include <QStringList>
#include <array>
#include <memory>
#include <random>
#include <set>

#include "gui/monkey/actions.h"
#include "gui/monkey/failing_room.h"
#include "gui/monkey/invariants.h"
#include "support/driven_program.h"

namespace relucent::gui {

/// How long the event loop left others waiting: how often within 20, 100, 250, 1000 ms, and longer.
struct LoopWaits {
  std::array<long, 5> counts{};
  double longest = 0.0;
};

struct WalkResult {
  int actions = 0, photographs = 0, restarts = 0;
  LoopWaits waits;
  QStringList findings;  // each with the seed and the actions that led there
};

/// One random walk through the program itself: a process of its own, used by mouse and keys, over venues of
/// which one is measured through the room's devices, which fail on the way. After each action, and while it
/// waits, the invariants are checked.
class Walk {
 public:
  /// `stock`: folders "real" and "rehearsal" with calibrations that are there to begin with, where it has
  /// them.
  Walk(unsigned seed, FailingRoom& room, QDir home, QDir venues, QDir stock);
  ~Walk();

  /// `known`: what was found before, which is not told again. `findsWaits`: a loop that leaves others waiting
  /// for more than a second is something that was found; otherwise only one that hangs is.
  WalkResult run(int actions, std::set<QString>& known, double mostSeconds, bool findsWaits);

 private:
  void start();
  /// As a person does it: a new venue with the room's devices, up to a measurement under way.
  bool leadToMeasuring();
  bool tryFor(const std::function<bool()>& done, int seconds = 30) const;
  Action next(const QJsonArray& usable);
  void act(const Action& action);
  /// Looks; what should not be is looked at until it goes or stays too long.
  QJsonObject look(std::set<QString>& known);
  void noteLoop(const QJsonObject& loop, std::set<QString>& known);
  /// Where the program has ended: as it should, or not.
  void noteEnd(std::set<QString>& known);
  void found(const QString& what, std::set<QString>& known);
  QString errors() const { return home_.filePath("errors"); }

  unsigned seed_;
  std::mt19937 random_;
  FailingRoom& room_;
  QDir home_, venues_;
  QString opened_;  // the venue that the program begins with; empty: none
  bool leads_ = false, findsWaits_ = true;
  std::unique_ptr<test::DrivenProgram> program_;
  Invariants invariants_;
  QStringList actions_;
  bool mayEnd_ = false;  // it was asked to
  WalkResult result_;
};

}  // namespace relucent::gui
