// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "relucent/base/progress.h"
#include "relucent/devices/check/check_verdict.h"
#include "relucent/devices/check/latency.h"
#include "relucent/rig/rig.h"

namespace relucent::devices {

struct LightCheckSettings {
  double frame = 1.0 / 60.0;  // seconds that the projector shows one picture
  double settle = 0.5;        // seconds until a flat field is steady
  int photographs = 24;       // of each flat field and exposure
  // What is worth a word, relative:
  double flicker = 0.02;
  double colours = 0.03;
  double bands = 0.03;
  double dither = 0.03;
};
std::vector<Message> problems(const LightCheckSettings& settings);

/// How steady a projector's light is within its frames, as a camera sees it. All are relative standard
/// deviations. b: brief exposures, w: whole frames; S_kcg: signal of photograph k, colour c, band of rows g,
/// less black, over the pixels that the projector lights.
struct LightCheck {
  double unsteady = 0.0;  // of S_k under w
  double flicker = 0.0;   // of S_k under b
  double colours = 0.0;   // of S_kcg / S_kg under b, the worst colour: colours one after the other
  double bands = 0.0;     // of S_kcg / S_kc under b: rows that are exposed one after the other
  double dither = 0.0;    // of single pixels of even grey against their band, beyond those of white
  double brief = 0.0;     // seconds of a brief exposure; 0: the camera can do none
  std::vector<CheckVerdict> verdicts{};
};

/// Photographs flat fields of white and grey at drifting phases of the projector's frame: with whole frames,
/// where light must be even, and with an eighth of a frame, where a lamp's modulation, a colour wheel, a
/// rolling shutter and dithering in time show. `exposure`: one at which white is well exposed.
/// What white's own noise explains is taken off `colours`, `bands` and `dither`.
/// Throws: Error{device} if the camera does not see the projector; Cancelled; as the devices.
LightCheck checkLight(rig::Projector& projector, rig::Camera& camera, double exposure,
                      const LightCheckSettings& settings, const Wait& wait, Progress& progress);

}  // namespace relucent::devices
