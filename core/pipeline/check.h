// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "base/progress.h"
#include "devices/latency.h"
#include "devices/light_check.h"
#include "devices/screen_proof.h"
#include "pipeline/rig_settings.h"

namespace relucent {

struct CheckSettings {
  RigSettings rig;
  LatencySettings latency;
  ScreenProofSettings proof;
};
std::vector<Message> problems(const CheckSettings& settings);

/// How a projector and a camera work together.
struct RigCheck {
  ScreenProof proof;  // which output the camera sees
  Latency latency;
  LightCheck light;
};
/// All that was found, in this order.
std::vector<CheckVerdict> verdictsOf(const RigCheck& check);

/// Opens the first projector and camera, and finds with an exposure at which white is well exposed: whether
/// the camera sees that projector (devices/screen_proof.h), how long a picture takes from one to the other
/// (devices/latency.h), and how steady the light is (devices/light_check.h).
/// Throws: Error{device} if the camera sees another output or none; as openRig() and measureLatency().
RigCheck checkRig(const CheckSettings& settings, const std::filesystem::path& cache, Progress& progress);

}  // namespace relucent
