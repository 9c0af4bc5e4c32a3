// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "relucent/base/progress.h"
#include "relucent/compensation/method.h"
#include "relucent/compensation/solver.h"
#include "relucent/compensation/target.h"
#include "relucent/compensation/uncorrectable.h"

namespace relucent::pipeline {

struct CompensateSettings {
  std::filesystem::path image;  // content, sRGB file or linear EXR
  compensation::Method method = compensation::Method::refined;
  compensation::SolverSettings::Algorithm solver =
      compensation::SolverSettings::Algorithm::fista;  // of `optimum`
  compensation::TargetSettings target;
  std::filesystem::path out;  // folder; created; files of the same names are replaced
  std::string set{};          // whose target takes the place of `target`, see sets.h; empty: none's
};
std::vector<Message> problems(const CompensateSettings& settings);

struct ContradictionShares {
  double share = 0.0;
  std::vector<double> views;  // camera after camera
};

struct CompensateResult {
  compensation::Method method = compensation::Method::refined;
  double psnrPredicted = 0.0;  // dB, prediction against target where reachable
  double clipped = 0.0;        // share of drive values at 0 or 1
  double reachable = 0.0;      // share of the content's camera pixels
  double seconds = 0.0;        // solving alone
  std::vector<std::filesystem::path> files;
  double deltaE = 0.0;  // mean CIEDE2000, prediction against target over the whole content
  std::map<compensation::Uncorrectable, double> uncorrectable{};  // shares of the content's pixels
  /// Where several cameras see it: how much of it other views make visibly worse, of all views and of each
  /// (compensation/contradiction.h). Empty with one.
  std::optional<ContradictionShares> contradiction{};
  std::vector<Message> notes{};  // on the views
  /// Half of the interval about the prediction within which 95 % of what is seen are expected, as a share of
  /// white: root of the mean square over the content (compensation/expected_error.h). None: it was not
  /// measured, but imported.
  std::optional<double> expectedError{};
};

/// Computes the pattern that makes the venue look like an image, and what the camera should then see.
/// Writes pattern.png (8-bit drive), pattern.exr (linear), target.exr, predicted.exr (camera signal per
/// second), target.png, predicted.png (to look at), delta_e.exr (CIEDE2000) and uncorrectable.exr, .png (the
/// number of its reason a pixel, see Uncorrectable; colours) into `out`; where several cameras see it,
/// contradiction.exr and .png too (CIEDE2000, a file each); of what was measured, expected_error.exr (camera
/// signal per second, half of the interval that is expected to hold 95 % of what is seen about the
/// prediction).
CompensateResult compensate(const std::filesystem::path& folder, const CompensateSettings& settings,
                            Progress& progress);

}  // namespace relucent::pipeline
