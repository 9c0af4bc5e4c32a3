// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "relucent/compensation/methods.h"
#include "relucent/image/image.h"

namespace relucent::compensation {

/// What views cost each other in one solve.
struct Contradiction {
  /// Per camera and pixel, CIEDE2000: how much further from what is wanted than if the view were alone. NaN
  /// outside the content, where a pixel is not usable, and in views that ask for nothing.
  std::vector<image::Image> worse;
  std::vector<double> shares;  // per camera: of those pixels, further by more than `visible`
  double share = 0.0;          // of those of all views
};

/// Differences that are just seen.
inline constexpr double visibleContradiction = 1.0;  // CIEDE2000

/// From a compensation p the steps a_k of `refined` go on twice, with the weights of all views and with those
/// of one view v alone,
///   p_W <- clamp01(p_W - a_k C_W grad f_W(p_W)),       W: all weights, or W_v
///   worse_i = dE(T p_W + e, wanted)_i - dE(T p_v + e, wanted)_i      for the pixels i of v
/// so that what more steps would have gained anyhow is no contradiction. Nothing of the kind with one view; 0
/// where all views want the same.  Cost: a run of `refined` for each view, and one.
/// Source: core/compensation/README.md.  Throws: Cancelled.
Contradiction contradictionOf(const Compensator& compensator, const Target& target,
                              const Compensation& compensation, Progress& progress);

/// What to tell whoever chose weights and places: views that see nothing of the content although they ask for
/// it, and pictures of their own that contradict each other in a twentieth of the views' pixels and more.
std::vector<Message> viewNotes(const MeasuredVenue& venue, const Target& target,
                               const Contradiction& contradiction);

}  // namespace relucent::compensation
