// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "relucent/base/progress.h"
#include "relucent/devices/check/latency.h"
#include "relucent/devices/check/light_check.h"
#include "relucent/devices/check/screen_proof.h"
#include "relucent/pipeline/rig_settings.h"

namespace relucent::pipeline {

struct CheckSettings {
  RigSettings rig;
  devices::LatencySettings latency;
  devices::ScreenProofSettings proof;
};
std::vector<Message> problems(const CheckSettings& settings);

/// How a projector and a camera work together.
struct RigCheck {
  devices::ScreenProof proof;  // which output the camera sees
  devices::Latency latency;
  devices::LightCheck light;
};
/// All that was found, in this order.
std::vector<devices::CheckVerdict> verdictsOf(const RigCheck& check);

/// Opens the first projector and camera, and finds with an exposure at which white is well exposed: whether
/// the camera sees that projector (devices/check/screen_proof.h), how long a picture takes from one to the
/// other (devices/check/latency.h), and how steady the light is (devices/check/light_check.h). Throws:
/// Error{device} if the camera sees another output or none; as openRig() and measureLatency().
RigCheck checkRig(const CheckSettings& settings, const std::filesystem::path& cache, Progress& progress);

}  // namespace relucent::pipeline
