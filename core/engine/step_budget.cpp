// SPDX-License-Identifier: MIT
#include "relucent/engine/step_budget.h"

#include <algorithm>

namespace relucent::engine {
namespace {

using Seconds = std::chrono::duration<double>;

constexpr double smoothing = 0.25;   // share of the newest frame
constexpr int framesToBelieve = 30;  // before one step more is taken
constexpr double reserve = 0.9;      // share of the budget that one step more may fill

void smooth(Seconds& mean, Seconds newest, bool known) {
  mean = known ? mean + smoothing * (newest - mean) : newest;
}

}  // namespace

void StepBudget::add(const FrameReport& frame) noexcept {
  smooth(fixed_, frame.seconds - frame.stepSeconds, known_);
  if (frame.steps > 0) smooth(step_, frame.stepSeconds / frame.steps, step_ > Seconds{});
  known_ = true;
  // Until a step has been seen, it is taken for half of the rest, which holds one pass over T of its two
  // passes over M and one over T.
  const Seconds step = step_ > Seconds{} ? step_ : 0.5 * fixed_;

  if (steps_ > 0 && fixed_ + steps_ * step > budget_) {
    --steps_;
    calm_ = 0;
    return;
  }
  const bool more = steps_ < most_ && fixed_ + (steps_ + 1) * step <= reserve * budget_;
  calm_ = more ? calm_ + 1 : 0;
  if (calm_ < framesToBelieve) return;
  ++steps_;
  calm_ = 0;
}

}  // namespace relucent::engine
