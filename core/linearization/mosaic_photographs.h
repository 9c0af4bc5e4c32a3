// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "relucent/linearization/camera_noise.h"
#include "relucent/linearization/response_fit.h"

namespace relucent::linearization {

/// Which of the photographs of mosaics shows what: of one projector after the other white and its lights;
/// then of all together the first groups in white, the levels and, of a single one, white again.
struct MosaicOrder {
  std::size_t projectors = 1;

  std::size_t lights() const { return 3 * mosaicGroupsOf(projectors); }  // of each
  std::size_t own() const { return 1 + lights(); }                       // of one projector alone
  std::size_t white(std::size_t projector) const { return projector * own(); }
  std::size_t light(std::size_t projector, std::size_t number) const { return white(projector) + 1 + number; }
  std::size_t groupsInWhite() const { return projectors * own(); }
};

/// All projectors' mosaics as they were photographed, thinned.
struct MosaicPhotographs {
  std::vector<std::vector<double>> drives;  // of each projector's levels, ascending, the last full
  std::vector<MosaicShot> what;             // in the order of order()
  std::vector<rig::Shot> shots;
  ShotPair white;  // all pictures of all projectors
  rig::Shot blackBefore, blackAfter;

  MosaicOrder order() const { return {drives.size()}; }
};

/// The levels that photographs show, and the photographs in terms of these alone.
struct ShownLevels {
  std::vector<std::vector<double>> drives;  // per projector
  std::vector<MosaicShot> what;
};
ShownLevels shownLevels(const MosaicPhotographs& photographs);

}  // namespace relucent::linearization
