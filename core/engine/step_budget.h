// SPDX-License-Identifier: MIT
#pragma once

#include "engine/backend.h"

namespace relucent {

/// Chooses K, the number of refinement steps, from what frames have taken: the most that a frame's budget
/// holds. Slow to believe that there is time for more, quick to do less.
class StepBudget {
 public:
  /// `budget`: what a frame may take in all. `most`: of the steps.
  StepBudget(std::chrono::duration<double> budget, int most) : budget_(budget), most_(most) {}

  int steps() const { return steps_; }
  /// What the last frame took. Frames that were not compensated say nothing and are not to be given.
  void add(const FrameReport& frame) noexcept;

 private:
  std::chrono::duration<double> budget_;
  int most_ = 0;
  int steps_ = 0;
  bool known_ = false;
  // Smoothed over frames: without the steps, and one step.
  std::chrono::duration<double> fixed_{}, step_{};
  int calm_ = 0;  // frames in a row that left time for one more
};

}  // namespace relucent
