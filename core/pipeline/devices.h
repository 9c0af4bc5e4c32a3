// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <utility>

#include "base/progress.h"
#include "pipeline/pipeline.h"
#include "rig/rig.h"
#include "transport/transport_matrix.h"
#include "venue/venue.h"

namespace relucent {

/// The devices of a calibration, ready for use.
struct OpenedRig {
  Rig rig;
  std::optional<SimulatedVenue> venue;  // set when the rig is simulated; its truth is for `evaluate` alone
};

/// Throws: Error{input, device, usage} if there are no such devices.
OpenedRig openRig(const RigSettings& settings, const std::filesystem::path& cache, Progress& progress);

/// Where a finished calibration that is looked at again has its devices from: opened when they are needed, or
/// somebody's who has them open.
class RigSource {
 public:
  explicit RigSource(std::filesystem::path cache) : cache_(std::move(cache)) {}
  explicit RigSource(Rig& open) : given_(&open) {}

  /// The devices, which stay open as long as this. `calibration` is named in errors.
  /// Throws: as openRig(); Error{input} if they have other sizes than T.
  Rig& open(const RigSettings& settings, const TransportMatrix& transport,
            const std::filesystem::path& calibration, Progress& progress);

 private:
  std::filesystem::path cache_;
  Rig* given_ = nullptr;
  std::optional<OpenedRig> opened_;
};

}  // namespace relucent
