// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>
#include <string>

#include "calibration/calibration_folder.h"
#include "pipeline/calibrate_settings.h"

namespace relucent {

/// What a person does with a calibration, in order. Some steps measure; at the others somebody looks at a
/// result and decides. Both leave a result in the calibration (StageResult), named by toString().
enum class Step { camera, linearization, acquisition, threshold, clustering, content };
inline constexpr std::array allSteps{Step::camera,    Step::linearization, Step::acquisition,
                                     Step::threshold, Step::clustering,    Step::content};
/// "camera", "linearization", ...: names of the stages for those that measure.
const char* toString(Step step);

/// Everything that a step's result depends on: the devices, and the settings of this step and of all before
/// it that measure or cut. Clusters and content both hang on the threshold, not on each other.
std::string fingerprintOf(const CalibrationFolder& folder, Step step);

/// Where a step stands.
enum class StepProgress { open, stale, done };
StepProgress progressOf(const CalibrationFolder& folder, Step step);

/// The newest result for the settings as they are, else the newest of all; none if the step was never done.
std::optional<StageResult> resultOf(const CalibrationFolder& folder, Step step);

/// Changes what later runs are asked for, and nothing else: the rig is what the calibration was begun with.
void changeSettings(CalibrationFolder& folder, const CalibrateSettings& settings);

/// Exchanges the devices of a calibration with which nothing has been measured yet.
/// Throws: Error{input} if something has, or for settings with problems(); Error{disk}.
void changeRig(CalibrationFolder& folder, const RigSettings& rig);

/// Uses the calibration with another screen: the projector's cable hangs elsewhere than when it was measured,
/// or another projector stands in its place. Nothing becomes stale: the same projector shines as it did, and
/// whether it is the same is for a verification to say. Of `screen` display and frame rate are taken.
/// Throws: Error{input} if the projector is no screen, or one of other pixels; Error{disk}.
void changeScreen(CalibrationFolder& folder, const ScreenRigSettings& screen);

/// Keeps that a step at which somebody decides is done, with figures for people.
void storeDecision(CalibrationFolder& folder, Step step, Json values);

}  // namespace relucent
