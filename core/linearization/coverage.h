// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "relucent/base/progress.h"
#include "relucent/rig/shot.h"

namespace relucent::linearization {

/// Which part of a projector's picture a camera sees, by cells of it.
struct Coverage {
  Size cells;                      // columns and rows of the picture
  std::vector<std::uint8_t> seen;  // per cell

  /// Of the picture.
  double share() const;
  /// Of the cells along an edge, how many are not seen.
  double missingLeft() const;
  double missingRight() const;
  double missingTop() const;
  double missingBottom() const;
};

/// Shows stripes and the same stripes inverted, in Gray code: at most 16 x 16 cells, each at least 8 pixels
/// of projector and camera wide. A camera pixel sees the cell whose stripes it follows,
///   |P - N| > 0.4 (P + N - 2 black),   P, N its signal under the stripes and under the inverted ones,
/// which light that comes from all around does not. A cell is seen that a tenth as many pixels see as see a
/// cell usually. Other projectors are black. At most 17 photographs of a projector by the first camera.
/// `exposure`: one at which white is well exposed, seconds.  Throws: as ShotTaker::take().
/// One Coverage for each projector.
std::vector<Coverage> coverageOf(rig::ShotTaker& shots, double exposure, Progress& progress);

}  // namespace relucent::linearization
