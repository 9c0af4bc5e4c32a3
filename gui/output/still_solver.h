// SPDX-License-Identifier: MIT
#pragma once

#include <mutex>
#include <optional>

#include "compensation/methods.h"
#include "output/frame_renderer.h"
#include "pipeline/measured_venue.h"

namespace relucent {

/// Pictures that stand, by any method and not only by the one that is quick enough for films: the converged
/// solution, once for each picture.
class StillSolver {
 public:
  /// `calibration` outlives it.
  StillSolver(const MeasuredCalibration& calibration, const TargetSettings& target,
              const ClusteringSettings& clustering, Method method);

  /// None if somebody interrupted it. Throws: as Compensator::solve().
  std::optional<RenderedFrame> solve(const ContentPicture& content);
  /// From another thread: the picture under way is given up.
  void interrupt();

 private:
  const MeasuredCalibration& calibration_;
  TargetSettings target_;
  Method method_;
  Compensator compensator_;
  std::uint64_t number_ = 0;  // of the picture that was solved last
  RenderedFrame last_;
  std::mutex guard_;
  std::shared_ptr<StopRequest> stop_;  // of the picture under way
};

}  // namespace relucent
