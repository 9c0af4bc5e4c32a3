// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <utility>

#include "base/progress.h"
#include "devices/screen_rig.h"
#include "pipeline/rig_settings.h"
#include "rig/rig.h"
#include "transport/transport_matrix.h"
#include "venue/venue.h"

namespace relucent {

/// The devices of a calibration, ready for use.
struct OpenedRig {
  Rig rig;
  std::optional<SimulatedVenue> venue;  // set when the rig is simulated; its truth is for `evaluate` alone
  std::shared_ptr<ScreenControl> screen{};  // set when the projector is a screen of the desktop
};

/// Makes the projector that is a screen of the desktop. Core has no windows: whoever has them gives this.
using ScreenOpener = std::function<std::unique_ptr<ScreenProjector>(const ScreenRigSettings&)>;

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
