// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>

#include "base/progress.h"
#include "pipeline/pipeline.h"
#include "rig/rig.h"
#include "venue/venue.h"

namespace relucent {

/// The devices of a calibration, ready for use.
struct OpenedRig {
  Rig rig;
  std::optional<SimulatedVenue> venue;  // set when the rig is simulated; its truth is for `evaluate` alone
};

/// Throws: Error{input, device, usage} if there are no such devices.
OpenedRig openRig(const RigSettings& settings, const std::filesystem::path& cache, Progress& progress);

}  // namespace relucent
