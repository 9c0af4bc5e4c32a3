// SPDX-License-Identifier: MIT
#pragma once

#include "calibration/json.h"

#include "pipeline/pipeline.h"

namespace relucent {

/// The documents of the command line: snake_case keys, numbers without units. What is not finite is null.
Json toJson(const CalibrateResult& result);
Json toJson(const ImportResult& result);
Json toJson(const CompensateResult& result);
Json toJson(const EvaluateResult& result);
Json toJson(const WrittenFiles& result);
Json toJson(const SeparateResult& result);
Json toJson(const DifferenceResult& result);
Json toJson(const BenchResult& result);
Json toJson(const std::vector<VenueDescription>& venues);

/// Settings as the calibration's manifest keeps them; what is read is what was written, number for number.
Json toJson(const RigSettings& settings);
Json toJson(const LinearizationSettings& settings);
Json toJson(const AcquisitionSettings& settings);
Json toJson(const WindowSettings& settings);
Json toJson(const CalibrateSettings& settings);

/// Reads what toJson(CalibrateSettings) wrote; keys that are missing keep their defaults.
/// Throws: Error{format} if a value has the wrong type.
CalibrateSettings calibrateSettingsFromJson(const Json& json);

}  // namespace relucent
