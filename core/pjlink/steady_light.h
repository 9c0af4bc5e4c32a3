// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <optional>
#include <span>
#include <vector>

#include "relucent/pjlink/waiting.h"
#include "relucent/rig/rig.h"

namespace relucent::pjlink {

struct SteadyLightSettings {
  std::chrono::seconds span{120};      // over which the light must not drift ...
  double share = 0.005;                // ... by more than this, relative
  std::chrono::seconds interval{10};   // between two looks
  std::chrono::seconds longest{1800};  // a lamp of the old kind needs up to half an hour
  float drive = 0.5f;                  // of the flat picture, encoded
};
/// Sentences about what cannot be.
std::vector<Message> problems(const SteadyLightSettings& settings);

/// A look at a projector's light.
struct LightSample {
  double seconds = 0.0;  // when
  double light = 0.0;    // mean camera signal a second, its black subtracted
};

/// How much light drifts, relative to its mean, over `span`:
///   |slope| span / mean,   slope the least-squares line through the samples,
/// and the standard deviation of that as their scatter around the line makes it.
struct LightDrift {
  double drift = 0.0, deviation = 0.0;
};
/// None: the samples are fewer than six, or cover less than nine tenths of `span`, or their mean is not above
/// 0.
std::optional<LightDrift> driftOf(std::span<const LightSample> samples, double span);

/// drift <= max(share, 2 deviations): what noise hides is no drift that a longer wait would show.
bool isSteady(const LightDrift& drift, double share);

struct SteadyLight {
  double seconds = 0.0;       // waited
  std::vector<double> drift;  // of each projector, at the end
};

/// Waits until the light of every projector is steady, as the cameras see it.
///   1. Exposures are chosen once, all projectors lit by a flat picture, and again when one overflows.
///   2. At every interval a photograph is taken with all of them black and one with each lit alone, so that
///   neither
///      room light nor one lamp that rises while another falls is mistaken.
///   3. driftOf() the last `span` of each decides.
/// Throws: Error{device} if a projector is seen by no camera, or one is not steady after `longest`; as the
/// devices; Cancelled.
SteadyLight awaitSteadyLight(rig::Rig& rig, const SteadyLightSettings& settings, const Waiting& waiting,
                             Progress& progress);

}  // namespace relucent::pjlink
