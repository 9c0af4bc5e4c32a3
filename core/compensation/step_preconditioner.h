// SPDX-License-Identifier: MIT
#pragma once

#include "relucent/compensation/solver.h"
#include "relucent/compensation/target.h"

namespace relucent::compensation {

/// C of steps of fixed lengths, as diagonalPreconditioner() has it, from the light of green alone:
///   C_jc = g_jc / D_j,   D = (Tᵀ W T 1)_green,   g_jc = (Tᵀ U T 1)_j,green / (Tᵀ U T 1)_jc
/// with U = 1 on the pixels that can be used. Where W is the same wherever a projector pixel's light arrives,
/// this is diagonalPreconditioner()'s; elsewhere they differ as far as colours of the surface do that are
/// weighed differently. A solver that may not overshoot takes that one. This one is what the real-time engine
/// has time for: one channel goes back through T beside the residual's three, in the lane that is left of
/// four. Where green hardly shows (10⁻⁵ of the channel's own light), C is the bound for the largest weights
/// that there are.
class StepPreconditioner {
 public:
  StepPreconditioner() = default;
  /// Shapes: one flag for each of T's camera pixels.
  StepPreconditioner(const transport::TransportMatrix& transport, const CameraMask& usable);

  /// g; where green hardly shows, -C; 0 where nothing is seen. Shape: projector stack.
  const ProjectorStack& share() const { return share_; }
  /// What D must exceed: what sees next to nothing would take steps of any length on rounding errors.
  float least() const { return least_; }

  /// 1 / D of a pixel that is free; where D is too small, next to nothing, for what does not need it.
  static constexpr float nextToNothing = 1e-30f;
  static float inverse(float bound, float least) { return bound > least ? 1.0f / bound : nextToNothing; }
  /// C of one value. `inverse`: of its pixel, 0 where that is not free.
  static float from(float share, float inverse) {
    if (share >= 0.0f) return share * inverse;
    return inverse > 0.0f ? -share : 0.0f;
  }
  /// C of a problem with weights W, where not all light is available a / (Tᵀ W T a). 0 on pixels that are not
  /// free.
  ProjectorStack of(const ConstrainedProblem& problem) const;

 private:
  ProjectorStack share_;
  float least_ = 0.0f;
};

}  // namespace relucent::compensation
