// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>

#include "photography/photographer.h"
#include "sentinels/inspection.h"
#include "sentinels/observer.h"

namespace relucent {

/// What was decided about alarms; outlives a measurement that begins again.
struct Decisions {
  AlarmHandler handler;
  std::map<int, std::string> putUpWith;  // alarms put up with, by the shot that they came before
};

struct WatchSettings {
  int checkInterval = 40;      // shots between two checks of e, the lamp and the view
  bool mayBeMirrored = false;  // pictures are meant to appear mirrored: rear projection, a mirror
};

/// Thrown out of a measurement whose doubtful shots have been forgotten: it is to begin again.
struct BeginAgain {};
/// Thrown out of a measurement that is to end with what was safe before the level under way.
struct KeepAndStop {};

/// Photographs while watching. Every `checkInterval` shots, and whenever check() is called, black and the
/// reference picture are photographed:
/// - e becomes the mean of all blacks so far or, where it has changed, the new one;
/// - the lamp's power follows from the reference picture, continued as a straight line until the next check;
/// - sentinels compare the view with the first one, see inspection.h, or with what was put up with since. On
///   an alarm the handler is asked;
/// - the observer is told of both.
/// Frames come out as light: less e, in units of the lamp's power at the first check.
class Watch {
 public:
  /// Keeps references; e in `references` follows the checks.
  Watch(Photographer& photographer, ShotTaker& shots, References& references, const WatchSettings& settings,
        Decisions& decisions, AcquisitionObserver& observer);

  const Rasters& cameras() const { return photographer_.cameras(); }
  const Rasters& projectors() const { return photographer_.projectors(); }

  /// The first look: which way round pictures appear, what the view is compared with later.
  void begin(const Progress& progress);
  /// Throws: BeginAgain, KeepAndStop; Error{device} if an alarm has nobody to handle it.
  void check(const Progress& progress);

  /// Light of a pattern, see Photographer::take. `meanwhile` goes on during that photograph, not during a
  /// check that is due before it: e does not change under its hands. Throws: as check().
  HdrFrame light(const Stack& pattern, const std::vector<Demand>& demands, const Progress& progress,
                 const Meanwhile& meanwhile = {});
  HdrFrame lightOfAll(const Stack& pattern, const Progress& progress, const Meanwhile& meanwhile = {});

  /// The next one's number.
  int shots() const { return shots_.shots(); }
  /// Tells the observer that patterns from `shot` on, whose light does not add up, are photographed again.
  void contradicted(int shot, int patterns);

  /// Power of the lamp now, relative to the first check.
  double power() const;

 private:
  struct Power {
    int shot = 0;
    double value = 1.0;
  };
  Check photographCheck(const Progress& progress);
  /// Looks at a check, tells the observer, and handles what it found wrong with the shots from `doubtful` on.
  void inspectCheck(const Check& now, double expectedPower, int doubtful);
  /// Asks what to do about an alarm of the shots from `doubtful` on. Comes back if it is put up with.
  void handle(const Alarm& alarm, int doubtful);
  void checkIfDue(const Progress& progress);
  /// Exposures of one pattern that contradict each other are an alarm of their own.
  void inspectBracket();
  /// What comes next is the last photograph.
  void beginPhotograph() { photographedBefore_ = shots_.times().shots; }
  /// The last photograph was taken now and not read from the log.
  bool isNew() const { return shots_.times().shots > photographedBefore_; }
  void follow(const Check& check);
  HdrFrame lightOf(HdrFrame frame) const;

  Photographer& photographer_;
  ShotTaker& shots_;
  References& references_;
  WatchSettings settings_;
  Decisions& decisions_;
  AcquisitionObserver& observer_;
  Check first_;  // its light that of a later one whose view was put up with, at the power of the first one's
                 // lamp
  Power last_, beforeLast_;
  int trusted_ = 0;             // shots before this one have been confirmed by a check
  int photographedBefore_ = 0;  // the last photograph, of those not read from the log
  double flicker_ = 0.0;        // the largest contradiction since the last check
};

}  // namespace relucent
