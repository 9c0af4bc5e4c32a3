// SPDX-License-Identifier: MIT
#pragma once

#include "relucent/calibration/room_on_disk.h"
#include "relucent/pipeline/calibrate.h"
#include "relucent/pipeline/kept_photographs.h"

namespace relucent::pipeline {

/// What a calibration takes of the disk.
struct Storage {
  KeptPhotographs kept = KeptPhotographs::everything;  // once it is complete
  calibration::RoomWaiter* room = nullptr;  // waits where the disk is full; null: that is a failure
};

/// As calibrate() and resume() of calibrate.h.
CalibrateResult calibrate(const std::filesystem::path& folder, const CalibrateSettings& settings,
                          const Storage& storage, const std::filesystem::path& cache,
                          const sentinels::AlarmHandler& handler, Progress& progress);
/// The photographs that are kept are those that it was begun with.
CalibrateResult resume(const std::filesystem::path& folder, calibration::RoomWaiter* room,
                       const std::filesystem::path& cache, const sentinels::AlarmHandler& handler,
                       Progress& progress);

}  // namespace relucent::pipeline
