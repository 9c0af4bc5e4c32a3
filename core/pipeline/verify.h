// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "relucent/acquisition/reverification.h"
#include "relucent/base/progress.h"
#include "relucent/pipeline/rig_settings.h"
#include "relucent/rig/rig.h"

namespace relucent::pipeline {

struct VerifySettings {
  std::filesystem::path out;       // folder for maps as EXR; created; empty: none
  std::optional<RigSettings> rig;  // none: the calibration's own; others must have its sizes
};
std::vector<Message> problems(const VerifySettings& settings);

struct VerifyResult {
  acquisition::Judgement judgement;
  acquisition::Reverification found;
  double errorThen = 0.0;  // of the same patterns when T was measured
  double seconds = 0.0;    // reading and preparing not included
  std::vector<std::filesystem::path> files;
};

/// Whether T still predicts the venue: photographs black and the held-out patterns again, ten shots or so,
/// and compares them (acquisition/reverification.h). Changes nothing in the calibration. Writes into `out`,
/// a file a camera: residual-1-1.exr to residual-8-1.exr (block size; root mean square of measured less
/// predicted, camera signal per second) and changed-1.exr (1 where a pixel changed).
/// Throws: Error{input} if the calibration is not finished, was imported, or has other sizes than the
/// devices; Error{device, disk}; Cancelled.
VerifyResult verifyCalibration(const std::filesystem::path& folder, const VerifySettings& settings,
                               const std::filesystem::path& cache, Progress& progress);
/// The same with devices that somebody has open already.
VerifyResult verifyCalibration(const std::filesystem::path& folder, const VerifySettings& settings,
                               rig::Rig& rig, Progress& progress);

}  // namespace relucent::pipeline
