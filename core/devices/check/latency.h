// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "relucent/base/progress.h"
#include "relucent/devices/check/check_verdict.h"
#include "relucent/rig/rig.h"

namespace relucent::devices {

struct LatencySettings {
  double frame = 1.0 / 60.0;  // seconds that the projector shows one picture
  int mostFrames = 30;        // after these any picture is out
  int repeats = 4;            // steps from black to white, and back, tried with each delay
  double settled = 0.03;      // share of the step that may be missing
  double flicker = 0.02;      // relative deviation between equal photographs that is worth a word
};
std::vector<Message> problems(const LatencySettings& settings);

/// How long after Projector::show() a photograph sees the new picture and nothing older.
struct Latency {
  int frames = 0;        // least delay that sufficed every time
  double seconds = 0.0;  // to be waited for: that delay and one frame of margin
  double step = 0.0;     // mean signal of white less black
  double flicker = 0.0;  // relative standard deviation of white between photographs
  std::vector<CheckVerdict> verdicts{};
};

/// Lets time pass. Seconds.
using Wait = std::function<void(double)>;
/// By the clock on the wall.
void sleepFor(double seconds);

/// Mean signal of a photograph, all pixels and channels.
double meanSignal(const rig::RawFrame& frame);

/// Steps between black and white, photographed after a delay that is halved until it no longer suffices:
///   a delay suffices if |1 - (signal - old) / (new - old)| <= settled in every step, both ways.
/// Every step starts from a picture that has been out for mostFrames, so that there are no more than three
/// opposite full-field changes a second with the usual settings.
/// Throws: Error{device} if the camera does not see the projector, or the picture takes longer than
/// mostFrames; Cancelled.
Latency measureLatency(rig::Projector& projector, rig::Camera& camera, double exposure,
                       const LatencySettings& settings, const Wait& wait, Progress& progress);

/// The same projector, whose show() returns so many seconds later.
std::unique_ptr<rig::Projector> delayed(std::unique_ptr<rig::Projector> projector, double seconds, Wait wait);

}  // namespace relucent::devices
