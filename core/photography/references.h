// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "relucent/photography/photographer.h"
#include "relucent/transport/block_sparse.h"

namespace relucent::photography {

/// What is measured once, before the tree: black, and every projector's floods in red, green and blue, which
/// are the root of its tree. It stays as it was measured; what becomes of e is followed by sentinels/watch.h.
struct References {
  Rasters cameras, projectors;  // rows and columns of T
  hdr::BlackLevel black;        // e
  std::vector<std::vector<transport::ColourBlock>>
      root;  // [projector][row]: flood less e, camera x projector channel
  std::vector<std::vector<transport::ColourBlock>> rootVariance;
  hdr::ProjectedLight firstRound;  // the first of each flood, all summed: what moved later shows against it
  int floodRounds = 1;             // of which the roots are the means
  CameraMask usable;               // per row: 0 where even the shortest exposure was saturated
  std::vector<float>
      strongest;         // F per row: the largest entry of the sum of all roots, not below the dimmest
  double flicker = 0.0;  // deviation of equal patterns' total light, relative, drift taken out
  float typical = 0.0f;  // the F above which half of all light lies
  std::vector<float> fullScale;  // per row: the largest magnitude that T may hold there
};

/// How often each is photographed; black at least as often as the floods.
struct ReferenceRounds {
  int black = 1, floods = 1;
};

/// Black and floods in turn, so that slow drift is the same in all of them. `dimShare`: see
/// AcquisitionSettings.
References measureReferences(Photographer& photographer, const ReferenceRounds& rounds, double dimShare,
                             Progress& progress);

}  // namespace relucent::photography
