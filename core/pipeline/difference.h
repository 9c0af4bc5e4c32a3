// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "relucent/base/progress.h"

namespace relucent::pipeline {

struct DifferenceSettings {
  std::filesystem::path first;
  std::filesystem::path second;  // of the same size
  std::filesystem::path out;     // EXR: gain * (first - second); PNG: that around grey
  /// None: PNG as much as shows all but the largest half percent of the differences, EXR 1.
  std::optional<double> gain;
};
std::vector<Message> problems(const DifferenceSettings& settings);

struct DifferenceResult {
  double rms = 0.0;       // of the difference of linear values
  double relative = 0.0;  // norm of the difference over that of the second picture
  double gain = 1.0;      // that was applied
  std::vector<std::filesystem::path> files;
};

/// Two pictures' difference in linear light with enhanced contrast (paper, fig. 2 d and g): what compensation
/// changed, or a prediction against a photograph. Values are compared as they are, unscaled.
/// Throws: Error{input} if the sizes differ or values are not finite; as readPicture().
DifferenceResult pictureDifference(const DifferenceSettings& settings, Progress& progress);

}  // namespace relucent::pipeline
