// SPDX-License-Identifier: MIT
#pragma once

#include "relucent/calibration/calibration_folder.h"
#include "relucent/calibration/prepared_files.h"
#include "relucent/linearization/linearization.h"
#include "relucent/transport/acquisition.h"

/// Results of the stages on disk and back, the same bits. What is small is JSON in the manifest, met in this
/// folder only. `inputs` is the fingerprint of all that the stage was given (stage_fingerprint.h); the cost
/// is kept with the result. Storing throws Error{disk}; reading throws Error{format} if a file or a value is
/// missing, damaged or contradicts another.
namespace relucent::calibration {

/// Curves, camera models and findings, all in the manifest.
StageResult storeLinearization(CalibrationFolder& folder, const std::string& inputs,
                               const linearization::Linearization& linearization, const StageCost& cost);
linearization::Linearization loadLinearization(const StageResult& result);

/// transport.npz (the leaves, see transport/files.h), and per camera black, flood, their variances and the
/// flags as OpenEXR; figures and findings in the manifest. `repair`: what it was made from, which then stays
/// among the results, to go back to, and whose content is in the settings with it, in one step. `prepared`:
/// where prepareAcquisition() has written its files.
StageResult storeAcquisition(CalibrationFolder& folder, const std::string& inputs,
                             const transport::Acquisition& acquisition, const StageCost& cost,
                             const std::optional<RepairNote>& repair = {},
                             const PreparedFiles* prepared = nullptr);
/// The files of an acquisition, before it is known whether it will be stored.
void prepareAcquisition(const PreparedFiles& files, const transport::Acquisition& acquisition);
/// The newest measurement is set aside, which a repair made, and content stands where it stood before that,
/// unless somebody has changed it since; in one step.
void setRepairAside(CalibrationFolder& folder, const RepairNote& repair);
transport::Acquisition loadAcquisition(const StageResult& result);
/// Of that alone what each camera saw in full light, linear: in no time where T takes long.
std::vector<image::Image> loadFlood(const StageResult& result);

/// Keeps how the inverse is made, for the settings as they are.
StageResult storeInverse(CalibrationFolder& folder, const InverseResult& result);

/// Keeps that a stage at which somebody decides is done, for the settings as they are.
StageResult storeDecision(CalibrationFolder& folder, const CameraCheckResult& result);
StageResult storeDecision(CalibrationFolder& folder, const ThresholdResult& result);
StageResult storeDecision(CalibrationFolder& folder, const ClusteringResult& result);
StageResult storeDecision(CalibrationFolder& folder, const ContentResult& result);

/// What a stored result says.
void read(const StageResult& stored, CameraCheckResult& result);
void read(const StageResult& stored, LinearizationResult& result);
void read(const StageResult& stored, AcquisitionResult& result);
void read(const StageResult& stored, ThresholdResult& result);
void read(const StageResult& stored, InverseResult& result);
void read(const StageResult& stored, ClusteringResult& result);
void read(const StageResult& stored, ContentResult& result);

template <Stage stage>
ResultOf<stage> resultFrom(const StageResult& stored) {
  require(stored.stage == stage, "a result of {} is read as one of {}", nameOf(stored.stage), nameOf(stage));
  ResultOf<stage> result;
  read(stored, result);
  return result;
}

/// The results of all stages: of each the one for the settings as they are, else the newest.
StageResults resultsIn(const CalibrationFolder& folder);

}  // namespace relucent::calibration
