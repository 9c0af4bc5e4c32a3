// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <utility>

#include "relucent/base/progress.h"
#include "relucent/calibration/calibration_folder.h"
#include "relucent/devices/screen_rig.h"
#include "relucent/pipeline/rig_settings.h"
#include "relucent/rig/rig.h"
#include "relucent/transport/transport_matrix.h"
#include "relucent/venue/venue.h"

namespace relucent::pipeline {

/// The devices of a calibration, ready for use.
struct OpenedRig {
  rig::Rig rig;
  std::optional<venue::SimulatedVenue>
      venue;  // set when the rig is simulated; its truth is for `evaluate` alone
  std::shared_ptr<devices::ScreenControl> screen{};  // set when the projector is a screen of the desktop
};

/// Makes the projector that is a screen of the desktop. Core has no windows: whoever has them gives this.
using ScreenOpener = std::function<std::unique_ptr<devices::ScreenProjector>(const ScreenRigSettings&)>;

/// Throws: Error{input, device, usage} if there are no such devices; Error{usage} for a screen of the desktop
/// without `screens`.
OpenedRig openRig(const RigSettings& settings, const std::filesystem::path& cache,
                  const ScreenOpener& screens, Progress& progress);
OpenedRig openRig(const RigSettings& settings, const std::filesystem::path& cache, Progress& progress);

/// Where a finished calibration that is looked at again has its devices from: opened when they are needed, or
/// somebody's who has them open.
class RigSource {
 public:
  explicit RigSource(std::filesystem::path cache) : cache_(std::move(cache)) {}
  explicit RigSource(rig::Rig& open) : given_(&open) {}

  /// The devices as the calibration measured with them (reductions.h); they stay open as long as this.
  /// Projectors on the network are switched on and waited for (warm_up.h), unless they were open. Throws: as
  /// openRig(), reducedRig() and ProjectorWarmUp; Error{input} if they have other sizes than T.
  rig::Rig& open(const RigSettings& settings, const transport::TransportMatrix& transport,
                 const calibration::CalibrationFolder& folder, Progress& progress);
  /// The same devices, whose cameras deliver all that they have. Contract: they are open.
  rig::Rig& whole();

 private:
  std::filesystem::path cache_;
  rig::Rig* given_ = nullptr;
  std::optional<OpenedRig> opened_;
  rig::Rig used_;
};

}  // namespace relucent::pipeline
