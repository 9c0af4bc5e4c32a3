// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "relucent/base/progress.h"
#include "relucent/pipeline/calibrate_settings.h"
#include "relucent/sentinels/alarm.h"

namespace relucent::pipeline {

struct CalibrateResult {
  int patterns = 0;   // shown, all stages
  int exposures = 0;  // photographed, all stages
  struct Seconds {    // wall time of each stage, earlier runs of a resumed calibration included
    double linearization = 0.0;
    double acquisition = 0.0;
    double inverse = 0.0;
  } seconds;
  std::uint64_t connections = 0;  // camera pixel - projector pixel pairs that T connects, expanded
  std::uint64_t leaves = 0;       // blocks stored
  double unresolvedEnergy = 0.0;  // share of the flood image that no leaf explains
  double flaggedShare = 0.0;      // share of camera pixels that verification found wrong
  double verificationError = 0.0;
  std::uint64_t peakMemoryBytes = 0;
  std::vector<Message> findings;  // sentences of all stages
  int linearizationExposures = 0;
};

/// Measures a venue into a new calibration folder. A simulated venue's transport is kept in `cache`.
/// Interrupted at any instant, the folder can be resumed.
/// Stop and keep: ends acquisition after the level under way and goes on with that.
/// Throws: Error{input} if `folder` already holds a calibration or anything else; Error{device, input, disk}.
CalibrateResult calibrate(const std::filesystem::path& folder, const CalibrateSettings& settings,
                          const std::filesystem::path& cache, Progress& progress);
/// The same with somebody to ask when a sentinel finds something wrong while the light transport is measured
/// (sentinels/alarm.h); with nobody, that is Error{device}, and resume() goes on from what is safe.
CalibrateResult calibrate(const std::filesystem::path& folder, const CalibrateSettings& settings,
                          const std::filesystem::path& cache, const sentinels::AlarmHandler& handler,
                          Progress& progress);

/// Goes on where an interrupted calibration stopped, or with one that was stopped and kept, with the settings
/// it was begun with. A finished one is reported as it is. Ends in the same bits as an uninterrupted run.
CalibrateResult resume(const std::filesystem::path& folder, const std::filesystem::path& cache,
                       Progress& progress);
CalibrateResult resume(const std::filesystem::path& folder, const std::filesystem::path& cache,
                       const sentinels::AlarmHandler& handler, Progress& progress);

}  // namespace relucent::pipeline
