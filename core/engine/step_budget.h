// SPDX-License-Identifier: MIT
#pragma once

#include "relucent/engine/backend.h"

namespace relucent::engine {

/// Chooses K, the number of refinement steps, from the times of previous frames: the most that fit a frame's
/// budget. Increases K slowly and decreases it at once.
class StepBudget {
 public:
  /// `budget`: time for a whole frame. `most`: the limit of K.
  StepBudget(std::chrono::duration<double> budget, int most) : budget_(budget), most_(most) {}

  int steps() const { return steps_; }
  /// Adds the time of the last frame. Only for compensated frames.
  void add(const FrameReport& frame) noexcept;

 private:
  std::chrono::duration<double> budget_;
  int most_ = 0;
  int steps_ = 0;
  bool known_ = false;
  // Smoothed times: a frame without steps, and one step.
  std::chrono::duration<double> fixed_{}, step_{};
  int calm_ = 0;  // consecutive frames that left time for one more step
};

}  // namespace relucent::engine
