// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "relucent/compensation/methods.h"
#include "relucent/image/image.h"
#include "relucent/pipeline/evaluate.h"
#include "relucent/pipeline/measured_venue.h"

namespace relucent::pipeline {

/// What one image truly looks like in the venue, as the first camera would see it without noise.
struct EvaluatedPictures {
  std::string name;
  image::Image wanted;
  std::map<compensation::Method, image::Image> seen;  // camera signal per second
  std::array<float, 3> white{};
  CameraMask inside;  // per pixel of the first camera
  double reachable = 0.0;
};

/// Figures, and the pictures that they were taken from.
struct Evaluation {
  EvaluateResult result;
  std::vector<EvaluatedPictures> pictures;
};

/// Every method on every image, through the venue's true transport.
/// Throws: Error{input} if the calibration is of a real venue: its truth is not known.
Evaluation evaluated(const MeasuredCalibration& measured, const EvaluateSettings& settings,
                     const std::filesystem::path& cache, Progress& progress);

}  // namespace relucent::pipeline
