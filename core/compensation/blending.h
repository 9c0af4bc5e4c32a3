// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "relucent/compensation/methods.h"

namespace relucent::compensation {

/// Which share of a camera pixel's picture each projector is to give, in the common way of several
/// projectors: with u_k the place in projector k that lights the pixel directly,
///   d_k = the distance of u_k from the nearest edge of k's picture, 1 at its centre,
///   s_k = (1 - cos(pi d_k)) / 2,        m_k = s_k / sum_l s_l
/// over the projectors that light it directly (DirectLeaves), and by their shares of the flood image where
/// none does: smooth ramps where pictures overlap, 1 where one projector is alone. Shapes: per projector, one
/// value a camera pixel; they sum to 1 where there is light. Source: Raskar et al. 1999, see
/// core/compensation/README.md.
std::vector<std::vector<float>> blendingMasks(const transport::TransportMatrix& transport,
                                              const DirectLightSettings& settings);

/// What a joint solve is compared with: every projector is compensated on its own, as if the others were
/// dark, for its masked part of the picture, and all of them are shown together,
///   p_k = argmin 1/2 sum_i w_i |(T_k p_k - m_k (wanted - e))_i|^2,   0 <= p_k <= 1
/// so that it keeps what it can of its light out of the others' parts, but knows nothing of the light that
/// they send into its own. (Not to mind it there was 0.8 dB worse in `dome4`.) Throws: as solveConstrained().
Compensation solvedSeparately(const Compensator& compensator, const Target& target,
                              const SolverSettings& settings, Progress& progress);

/// With one projector alone, the others black: p_k = argmin 1/2 sum_i w_i |(T_k p_k - (wanted - e))_i|^2 over
/// 0 <= p_k <= 1. Throws: as solveConstrained().
Compensation solvedAlone(const Compensator& compensator, const Target& target, std::size_t projector,
                         const SolverSettings& settings, Progress& progress);

}  // namespace relucent::compensation
