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

/// What cameras see of projectors.
struct RigCoverage {
  std::vector<std::vector<Coverage>> coverages;  // per projector and camera
  /// Per camera and pixel: a bit for each projector that lights it directly, the first one's the lowest:
  /// whose stripes it follows, all but one of the columns and one of the rows, which may end there.
  std::vector<std::vector<std::uint32_t>> litBy;

  /// Per projector: a cell is seen if any camera sees it.
  std::vector<Coverage> byAnyCamera() const;
  /// How large a share of what any projector lights in a camera's view each number of projectors light at
  /// once, from one on. Empty: none lights it.
  std::vector<double> overlaps(std::size_t camera) const;
};

/// Shows stripes and the same stripes inverted, in Gray code: at most 16 x 16 cells, each at least 8 pixels
/// of projector and cameras wide. A camera pixel sees the cell whose stripes it follows,
///   |P - N| > 0.4 (P + N - 2 black),   P, N its signal under the stripes and under the inverted ones,
/// which light that comes from all around does not. A cell is seen that a tenth as many pixels see as see a
/// cell usually. Other projectors are black. At most 17 photographs of a projector, by all cameras at once.
/// `exposure`: one at which white is well exposed, seconds.  Throws: as ShotTaker::take().
/// Contract: at most 32 projectors.
RigCoverage coverageOf(rig::ShotTaker& shots, double exposure, Progress& progress);

}  // namespace relucent::linearization
