// SPDX-License-Identifier: MIT
#pragma once

#include <QDateTime>
#include <QJsonObject>
#include <filesystem>
#include <optional>

#include "output/night_schedule.h"
#include "output/show_settings.h"
#include "relucent/pipeline/night.h"

namespace relucent::gui {

/// The nights of a show: which one is due, and what came of the last one. Their lines are in the
/// calibration's history, so that a show that was started again goes on where it was.
class ShowNights {
 public:
  /// `now`: a night that was due before, and has no line, was missed if others have one; where there is no
  /// history the first one is still to come.
  ShowNights(const ShowSettings& settings, const QDateTime& now);

  enum class Step { none, begin, missed, end };
  /// What the clock asks for. `missed` once for each night.
  Step stepAt(const QDateTime& now);

  void begin(const QDateTime& now);
  bool isUnderWay() const { return begun_.has_value(); }
  /// It has ended, with its line in the history. `failure`: without one, and why.
  void ended(const QDateTime& now, const Message& failure = {});
  /// Adds a line that says why it was left out. Throws: Error{disk}.
  void leaveOut(const QDateTime& now, const Message& why);
  /// Ends one that could not be, as an alarm. Throws: Error{disk}.
  void raise(const QDateTime& now, const Message& alarm);

  /// What is done to the venue: the stills of the playlist as the show has them.
  pipeline::NightSettings work() const;
  /// Why somebody has to look; empty: nobody has to.
  const Message& alarm() const { return alarm_; }
  const std::optional<pipeline::NightRecord>& last() const { return last_; }
  /// As health.json has it.
  QJsonObject health(const QDateTime& now) const;

 private:
  void recall();
  pipeline::NightRecord recordAt(const QDateTime& now) const;

  const ShowSettings& settings_;
  NightSchedule schedule_;
  QDateTime handled_;  // the night that was done or left out last
  std::optional<QDateTime> begun_;
  std::optional<pipeline::NightRecord> last_;
  Message alarm_;
};

/// What came of a night in a sentence, for logs and remote controls.
Message sentenceOf(const pipeline::NightRecord& night);

}  // namespace relucent::gui
