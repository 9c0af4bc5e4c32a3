// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "relucent/monitoring/synchronisation.h"

namespace relucent::monitoring {

/// What one photograph says of one part of the view.
struct CellLight {
  double share = 1.0;      // of the predicted light that is there
  double deviation = 1e9;  // standard deviation of it; large: too little light is predicted
};

/// What one photograph says of the light.
struct LightFit {
  std::vector<double> gain, deviation;        // per projector and channel: 1 as it was measured
  std::vector<double> total, totalDeviation;  // per projector: all channels together
  std::vector<double> room;                   // per camera channel, of e; then of the flood image
  /// Share of the predicted light that lies where the photograph is as these say; likewise of each
  /// projector's.
  double recognised = 0.0;
  std::vector<double> recognisedOf;
  double light = 0.0;  // mean predicted light, of the flood image
  std::vector<CellLight> cells;
  std::vector<float> predicted;  // radiance at all samples, three values each, as these say
  std::vector<float> along;      // how it changes a moment later; empty: it does not
};

/// Fits a photograph y by
///   y = e + sum_jk g_jk (T p)_jk + sum_c (a_c e_c + b_c (T 1)_c) + d (T p)_along,
/// g the gain of each projector's channels, a >= -1 and b >= 0 more room light than e has, d the rest of the
/// moment: weighted least squares, iterated with Tukey's weights that become narrower from round to round
/// (graduated non-convexity), so that whoever stands in the view is left out. Deviations are those of the
/// sandwich over cells, since T's errors are alike at neighbouring pixels.
/// Sources: Huber & Ronchetti, Robust Statistics, 2009; Blake & Zisserman, Visual Reconstruction, 1987;
/// White, Econometrica 48, 1980; core/monitoring/README.md.
LightFit fitLight(const Observed& seen, const Moment& moment, const WatchedVenue& venue);

}  // namespace relucent::monitoring
