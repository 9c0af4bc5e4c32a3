// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "relucent/sentinels/movement.h"
#include "relucent/transport/transport_matrix.h"

namespace relucent::acquisition {

/// What has become of a venue since its T was measured.
struct VenueChange {
  std::vector<sentinels::Movement> moved;     // of every camera's view; zero: it looks where it looked
  std::vector<sentinels::Movement> pictures;  // of the projectors' picture as every camera sees it, where
                                              // what it falls on has not moved: projectors were
  std::vector<transport::ColourBlock> light;  // of every projector: its channels' light as a share of what it
                                              // was, in each of the cameras' channels
  double ambient = 0.0;                       // change of e, as a share of the mean flood image
  double wrong = 0.0;    // share of camera pixels that do not see what the former T predicts
  double scaled = 0.0;   // share whose light is another than elsewhere, like repainted surfaces
  double unknown = 0.0;  // share that sees what no camera saw before

  /// The light is another, of a projector or of what some camera pixels see.
  bool isOfLight() const;
};

/// Of the camera pixels `among` those that are flagged.
double flaggedShareOf(const CameraMask& flags, const CameraMask& among);

}  // namespace relucent::acquisition
