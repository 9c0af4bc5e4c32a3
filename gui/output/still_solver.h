// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <mutex>
#include <vector>

#include "output/frame_renderer.h"
#include "relucent/compensation/methods.h"
#include "relucent/pipeline/measured_venue.h"

namespace relucent::gui {

/// Computes still pictures by any method with all of T: the operators for films keep only one colour mixing
/// per camera pixel, see PackedTransport. Each picture is solved once.
class StillSolver {
 public:
  /// `calibration` must outlive it.
  StillSolver(const pipeline::MeasuredCalibration& calibration, const compensation::TargetSettings& target,
              const clustering::ClusteringSettings& clustering, compensation::Method method);

  /// Null if it is outdated or was interrupted; valid until the next call. `viewWeights`: of every view;
  /// empty: as the target's settings have them.
  /// Throws: as Compensator::solve().
  const compensation::Compensation* solve(const ContentPicture& content, const Outdated& outdated = {},
                                          const std::vector<double>& viewWeights = {});
  /// From another thread: abandons the current picture.
  void interrupt();

 private:
  const pipeline::MeasuredCalibration& calibration_;
  compensation::TargetSettings target_;
  compensation::Method method_;
  compensation::Compensator compensator_;
  std::uint64_t number_ = 0;  // of the last solved picture
  std::vector<double> viewWeights_;
  compensation::Compensation last_;
  std::mutex guard_;
  std::shared_ptr<StopRequest> stop_;  // of the current picture
};

}  // namespace relucent::gui
