// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <mutex>

#include "compensation/methods.h"
#include "output/frame_renderer.h"
#include "pipeline/measured_venue.h"

namespace relucent {

/// Pictures that stand, by any method and all of T: what is quick enough for films keeps one colour mixing
/// for each camera pixel, see PackedTransport. Each picture is solved once.
class StillSolver {
 public:
  /// `calibration` outlives it.
  StillSolver(const MeasuredCalibration& calibration, const TargetSettings& target,
              const ClusteringSettings& clustering, Method method);

  /// Null if it is outdated or somebody interrupted it; valid until the next call.
  /// Throws: as Compensator::solve().
  const Compensation* solve(const ContentPicture& content, const Outdated& outdated = {});
  /// From another thread: the picture under way is given up.
  void interrupt();

 private:
  const MeasuredCalibration& calibration_;
  TargetSettings target_;
  Method method_;
  Compensator compensator_;
  std::uint64_t number_ = 0;  // of the picture that was solved last
  Compensation last_;
  std::mutex guard_;
  std::shared_ptr<StopRequest> stop_;  // of the picture under way
};

}  // namespace relucent
