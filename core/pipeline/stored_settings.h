// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "relucent/calibration/calibration_folder.h"
#include "relucent/pipeline/calibrate_settings.h"
#include "relucent/reduction/reduction.h"

namespace relucent::pipeline {

/// A new calibration in which nothing has been measured, with whatever settings.
/// Throws: as CalibrationFolder::create().
calibration::CalibrationFolder createCalibration(const std::filesystem::path& path,
                                                 const CalibrateSettings& settings);

/// What a calibration was asked for, with the screen and the commands that it uses now. Throws:
/// Error{format}.
CalibrateSettings settingsOf(const calibration::CalibrationFolder& folder);

/// The devices as they were when the calibration was begun: the screen at its place of then.
/// Throws: Error{format}.
RigSettings measuredRigOf(const calibration::CalibrationFolder& folder);

/// Changes what later runs are asked for, and nothing else: the rig is what the calibration was begun with.
void changeSettings(calibration::CalibrationFolder& folder, const CalibrateSettings& settings);

/// How the cameras are reduced, as it was chosen (reductions.h), one a camera; empty: they are used as they
/// are. Throws: Error{format}.
std::vector<reduction::Reduction> reductionsOf(const calibration::CalibrationFolder& folder);
/// Whether anything was chosen, that they stay as they are included.
bool hasReductions(const calibration::CalibrationFolder& folder);
/// None: all pixels are used. Throws: Error{disk}.
void keepReductions(calibration::CalibrationFolder& folder,
                    const std::vector<reduction::Reduction>& reductions);
/// They are to be chosen anew: what was measured before is out of date, whatever it was measured with.
/// Throws: Error{disk}.
void forgetReductions(calibration::CalibrationFolder& folder);

/// Exchanges the devices of a calibration with which nothing has been measured yet.
/// Throws: Error{input} if something has, or for settings with problems(); Error{disk}.
void changeRig(calibration::CalibrationFolder& folder, const RigSettings& rig);

/// Uses the calibration with another screen: the projector's cable hangs elsewhere than when it was measured,
/// or another projector stands in its place. Nothing becomes stale: the same projector shines as it did, and
/// whether it is the same is for a verification to say. Of `screen` display and frame rate of its first
/// screen are taken, for the projector of that number. Throws: Error{input} if the projector is no screen, or
/// one of other pixels; Error{disk}.
void changeScreen(calibration::CalibrationFolder& folder, const ScreenRigSettings& screen,
                  std::size_t projector = 0);

/// Reaches the devices of the calibration by other commands, in the order of commandsOf() of its rig. Nothing
/// becomes stale: the same devices show and photograph, and whether they do is for a verification to say.
/// Throws: Error{input} if they are not as many, or for settings with problems(); Error{disk}.
void changeCommands(calibration::CalibrationFolder& folder, const std::vector<std::string>& commands);

}  // namespace relucent::pipeline
