// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "devices/latency.h"
#include "pipeline/pipeline.h"

namespace relucent {

struct CheckSettings {
  RigSettings rig;
  LatencySettings latency;
};
std::vector<std::string> problems(const CheckSettings& settings);

/// Opens the first projector and camera and measures how long a picture takes from one to the other
/// (devices/latency.h), with an exposure at which white is well exposed.
/// Throws: as openRig() and measureLatency().
Latency checkRig(const CheckSettings& settings, const std::filesystem::path& cache, Progress& progress);

}  // namespace relucent
