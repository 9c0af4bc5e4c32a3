// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "relucent/base/progress.h"
#include "relucent/compensation/methods.h"
#include "relucent/pipeline/measured_venue.h"

namespace relucent::pipeline {

/// A viewer who walks past all cameras, from one end of their row to the other, while a show follows him.
struct WalkSettings {
  int frames = 0;                // pictures on the way; 0: nobody walks
  int steps = 2;                 // of refinement in each
  std::filesystem::path film{};  // folder for what is seen, frame-0001.png and on; empty: none
};
std::vector<Message> problems(const WalkSettings& settings);

struct WalkFrame {
  compensation::Position viewer{};
  std::vector<double> weights;  // of the views, which sum to one
  std::vector<double> psnr;     // dB of the reachable pixels, view after view; NaN: it has none
  std::vector<double> unseen;   // the same of places where no camera stands
};

/// What is seen of a projection.
struct WalkSight {
  std::vector<double> psnr, unseen;
  std::vector<image::Image> views;  // as they look, 0 to 1
};
using WalkJudge = std::function<WalkSight(const compensation::Compensation&, const compensation::Target&)>;

/// Follows him as a show does: ViewFollower, and every frame a few steps from the one before; the first as
/// well as all steps make it. On the processor.  Throws: Error{input} if a camera's position is not known, or
/// there is only one camera; Error{disk}.
std::vector<WalkFrame> walk(const MeasuredCalibration& measured, const image::Image& content,
                            const compensation::TargetSettings& target, const WalkSettings& settings,
                            const WalkJudge& judge, Progress& progress);

}  // namespace relucent::pipeline
