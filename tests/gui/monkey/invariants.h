// SPDX-License-Identifier: MIT
#pragma once

#include <QJsonObject>
#include <QString>
#include <vector>

#include "gui/monkey/failing_room.h"
#include "support/driven_program.h"

namespace relucent::gui {

/// Something that should not be. What needs a while to be said everywhere is wrong only if it stays.
struct Suspicion {
  QString what;
  double stays = 0.6;  // seconds
};

/// What holds at every moment, judged by what stands on the windows and shines on the projector's screen.
class Invariants {
 public:
  explicit Invariants(const FailingRoom& room) : room_(room) {}

  /// `survey`: the hand's, see support/hand/window_faults.h.
  std::vector<Suspicion> broken(const test::Seen& seen, const QJsonObject& survey);

 private:
  /// The progress falls or is whole while work goes on.
  void lookAtProgress(const test::Seen& seen, const QJsonObject& progress, std::vector<Suspicion>& all);

  const FailingRoom& room_;
  QString work_;  // whose progress it was
  int permille_ = 0, forecast_ = 0;
};

}  // namespace relucent::gui
