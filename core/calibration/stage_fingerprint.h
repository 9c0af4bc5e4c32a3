// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "relucent/calibration/calibration_folder.h"

namespace relucent::calibration {

/// A fingerprint of everything that a stage's result depends on, as the manifest says it: the devices, and
/// the settings of this stage and of all before it. Each includes that of its predecessor, so that a changed
/// setting or a newer version of an algorithm makes all later results out of date. Settings that the manifest
/// lacks because a later version added them leave it as it was. A measurement that was stopped early is
/// another than the one that went on, though its settings are the same: what follows from it knows where it
/// was stopped. So is an earlier measurement, which is used until there is one for the settings as they are.
std::string fingerprintOf(const CalibrationFolder& folder, Stage stage);
/// The same if the settings were these.
std::string fingerprintOf(const CalibrationFolder& folder, Stage stage, const Json& settings);

/// One link of that chain:
///   f_0 = inputs;  f_k = hash{inputs: f_(k-1), stage: section k, settings: what the manifest says of it}
/// and after the last section, for every version of the algorithm but the first,
///   hash{inputs: f_n, stage: name, version}.
/// Version 1 adds nothing, so that what was measured before stages had versions is still current.
std::string fingerprintAfter(const std::string& inputs, const StageDescription& stage, const Json& settings);

}  // namespace relucent::calibration
