// SPDX-License-Identifier: MIT
#pragma once

#include <functional>

#include "relucent/base/message.h"

namespace relucent::sentinels {

/// What a sentinel can find wrong while the light transport is being measured.
enum class AlarmKind {
  flicker,          // the light differs between exposures of one pattern
  unsteady,         // exposures of one pattern differ: by flicker, or by something that moved
  ambientChanged,   // light that is not the projectors'
  lampChanged,      // the projectors became brighter or dimmer
  moved,            // a camera or a projector was shifted or turned
  localChange,      // something stands in part of the view
  mirroredScreen,   // pictures appear the wrong way round
  wrongScreen,      // pictures do not appear as they were given
  coveredLens,      // the camera sees nothing
  projectorAsleep,  // the projectors show nothing
};

/// Whether a measurement that goes on in spite of it may still be of use. All else has to be put right.
constexpr bool isAcceptable(AlarmKind kind) {
  return kind == AlarmKind::flicker || kind == AlarmKind::unsteady || kind == AlarmKind::ambientChanged ||
         kind == AlarmKind::lampChanged || kind == AlarmKind::moved || kind == AlarmKind::localChange;
}

/// A finding that pauses the measurement.
struct Alarm {
  AlarmKind kind = AlarmKind::flicker;
  Message what;                 // what happened
  Message safe;                 // which photographs are safe
  Message advice;               // what to do
  int first = 0, patterns = 0;  // what is not safe: it is photographed again on retry
  bool mayStay = false;         // where all is measured anew, it need not be put back
  bool isGone = false;          // it was there before: as it is now may be as it should be
};

/// - retry: what is not safe is photographed again, from devices that have been put right;
/// - skip: this finding is accepted, and named among the acquisition's findings. The next check compares
///   with what is there now: it raises an alarm if that changes again;
/// - keepAndStop: ends with what is safe, a valid but coarser T.
enum class Answer { retry, skip, keepAndStop };

/// Asked while the measurement waits. Empty: nobody is there; the measurement stops with Error{device} after
/// forgetting what is not safe, so that running it again goes on from there.
using AlarmHandler = std::function<Answer(const Alarm&)>;

}  // namespace relucent::sentinels
