// SPDX-License-Identifier: MIT
#pragma once

#include <QMutex>
#include <QObject>
#include <QString>
#include <array>
#include <chrono>
#include <memory>
#include <optional>
#include <vector>

#include "relucent/pipeline/acquisition_record.h"
#include "relucent/pipeline/outlook.h"
#include "relucent/sentinels/observer.h"
#include "wizard/session/session.h"

namespace relucent::gui {

/// What one of the watches says, in words.
struct WatchState {
  bool isKnown = false;
  bool isSteady = true;
  QString sentence, figure;
};

/// What was photographed again, in words.
struct TakenAgain {
  QString patterns, reason;
};

/// What the checks of a measurement said and what was taken again, in order. Told on the measuring thread, it
/// speaks on its own.
class AcquisitionTrace : public QObject, public sentinels::AcquisitionObserver {
  Q_OBJECT

 public:
  using QObject::QObject;

  struct Point {
    double seconds = 0.0;  // since begin()
    sentinels::Reading reading;
  };
  struct Mark {
    double seconds = 0.0;
    sentinels::Retake retake;
  };

  /// What such an alarm is called, a title.
  static QString headingOf(sentinels::AlarmKind kind);
  /// What had happened, within a sentence.
  static QString reasonOf(sentinels::AlarmKind kind);

  /// What was told is forgotten, and nothing is listened to until begin().
  void clear();
  /// Anew. To be called before the measuring thread begins.
  void begin();
  void end();
  /// As it is on record of a measurement of another session.
  void recall(const pipeline::AcquisitionRecord& record);
  /// Since begin(), until end().
  double seconds() const;

  const std::vector<Point>& points() const { return points_; }
  const std::vector<Mark>& marks() const { return marks_; }
  /// Room light, the view, the projector, flicker.
  std::array<WatchState, 4> states() const;
  /// Patterns of the levels that have begun, coarsest first, and how many of the last one's are through. Not
  /// told by changed(): it changes with every photograph.
  struct Growth {
    std::vector<int> levels;
    int through = 0;
  };
  Growth growth() const;
  /// As it was seen last; none before it was.
  std::optional<RoomLight> roomLight() const;
  /// Why patterns are being photographed again: what the last check found, until the next one.
  std::optional<sentinels::AlarmKind> takesAgainFor() const;
  /// From the first pattern on, as what it is compared with may be wrong.
  bool takesAllAgain() const;
  /// The last ones, newest first.
  std::vector<TakenAgain> takenAgain(std::size_t most) const;

  /// What may be expected by now; none before there is a first look.
  using SharedOutlook = std::shared_ptr<const pipeline::Outlook>;
  const SharedOutlook& outlook() const { return outlook_; }
  /// From any thread.
  void expects(const pipeline::Outlook& outlook);

  /// What somebody is asked about, until he has answered: perhaps found between two checks, of which no
  /// reading says it.
  void setAsked(std::optional<sentinels::AlarmKind> alarm);
  /// What the last check found was put right by hand, and is not looked at again yet.
  void setPutRight(bool isPutRight);
  bool isPutRight() const { return isPutRight_; }

  void checked(const sentinels::Reading& reading) override;
  void takenAgain(const sentinels::Retake& retake) override;
  void grew(const std::vector<int>& levels, int through) override;

 Q_SIGNALS:
  void changed();

 private:
  const Mark* lastAnswer() const;
  bool isFoundSince() const;
  /// The last check, with the alarm that somebody is asked about. Contract: there was one.
  sentinels::Reading now() const;

  using Clock = std::chrono::steady_clock;
  std::vector<Point> points_;
  std::vector<Mark> marks_;
  std::optional<Clock::time_point> began_, ended_;
  SharedOutlook outlook_;
  std::optional<sentinels::AlarmKind> asked_;
  bool isRecalled_ = false, isPutRight_ = false;
  mutable QMutex guard_;
  Growth growth_;
};

}  // namespace relucent::gui
