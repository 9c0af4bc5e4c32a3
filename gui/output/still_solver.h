// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <mutex>

#include "compensation/methods.h"
#include "output/frame_renderer.h"
#include "pipeline/measured_venue.h"

namespace relucent {

/// Computes still pictures by any method with all of T: the operators for films keep only one colour mixing
/// per camera pixel, see PackedTransport. Each picture is solved once.
class StillSolver {
 public:
  /// `calibration` must outlive it.
  StillSolver(const MeasuredCalibration& calibration, const TargetSettings& target,
              const ClusteringSettings& clustering, Method method);

  /// Null if it is outdated or was interrupted; valid until the next call.
  /// Throws: as Compensator::solve().
  const Compensation* solve(const ContentPicture& content, const Outdated& outdated = {});
  /// From another thread: abandons the current picture.
  void interrupt();

 private:
  const MeasuredCalibration& calibration_;
  TargetSettings target_;
  Method method_;
  Compensator compensator_;
  std::uint64_t number_ = 0;  // of the last solved picture
  Compensation last_;
  std::mutex guard_;
  std::shared_ptr<StopRequest> stop_;  // of the current picture
};

}  // namespace relucent
