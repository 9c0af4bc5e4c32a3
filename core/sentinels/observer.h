// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "relucent/sentinels/alarm.h"
#include "relucent/transport/draft.h"

namespace relucent::sentinels {

/// Beyond these the sentinels raise an alarm: more than drift does between two checks.
namespace reading_limit {

inline constexpr double roomLight = 0.004;  // off e, of the typical flood: half of the usual threshold
inline constexpr double view = 0.1;         // of the reference picture, relative: not noise, not drift
inline constexpr double lamp = 0.1;         // between neighbouring checks
// Exposures of one pattern may contradict each other by this much: their times are known to some per mille.
inline constexpr double flicker = 0.03;

}  // namespace reading_limit

/// What a check of the light and the view says in numbers. Room light is what is seen under black projectors,
/// mean, relative to the typical flood.
struct Reading {
  int shot = 0;                    // patterns photographed by then, its own included
  double roomLight = 0.0;          // now
  double roomLightAtFirst = 0.0;   // at the first check
  double roomLightExpected = 0.0;  // e, from which it may be off by its limit
  double view = 0.0;               // difference of the reference picture from the first, relative, less noise
  double lamp = 1.0;               // power relative to the first check
  double lampExpected = 1.0;       // from which it may be off by its limit
  double flicker = 0.0;            // the most that a pattern's exposures differed since the check before
  std::optional<AlarmKind> alarm;  // what the sentinels make of it
};

/// Why patterns are photographed again.
enum class RetakeReason {
  alarm,          // and the handler said retry
  overexposed,    // in every exposure that was thought right: once more, with shorter ones
  contradiction,  // their light does not add up to what was seen before: something passed by
  dark,  // a check just after it found nothing wrong: the lens was covered, or the picture gone, for a moment
};

struct Retake {
  int shot = 0;  // the first pattern that is taken again
  int patterns = 1;
  RetakeReason reason = RetakeReason::alarm;
  std::optional<AlarmKind> alarm{};  // where that is the reason
};

/// Looks on while the light transport is measured, on the measuring thread. Is told what is photographed, not
/// what is read from a log: of an earlier run, or of what was safe before an alarm.
class AcquisitionObserver {
 public:
  virtual ~AcquisitionObserver() = default;
  /// Before the handler is asked about an alarm.
  virtual void checked(const Reading&) {}
  virtual void takenAgain(const Retake&) {}
  /// Of the tree, patterns read from a log included: those of the levels that have begun, coarsest first, and
  /// how many of the last one's are through.
  virtual void grew(const std::vector<int>& /*levels*/, int /*through*/) {}
  /// Whether drafted() is to be told.
  virtual bool wantsDrafts() const { return false; }
  /// Of dense patterns: what is measured so far, after each level, and at the finest after every few
  /// patterns.
  virtual void drafted(const transport::Draft&) {}
};

}  // namespace relucent::sentinels
