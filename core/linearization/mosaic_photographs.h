// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "relucent/linearization/camera_noise.h"
#include "relucent/linearization/response_fit.h"

namespace relucent::linearization {

/// All projectors' mosaics as they were photographed, thinned.
struct MosaicPhotographs {
  std::vector<std::vector<double>> drives;  // of each projector's levels, ascending, the last full
  /// Of one projector after the other white and the nine lights; then of all together the first groups in
  /// white, the levels and, of a single one, white again.
  std::vector<MosaicShot> what;
  std::vector<rig::Shot> shots;
  ShotPair white;  // all pictures of all projectors
  rig::Shot blackBefore, blackAfter;
};

/// Of one projector alone: white and its nine lights.
inline constexpr std::size_t ownPhotographs = 1 + mosaicLights;

/// Which of MosaicPhotographs::what shows a projector's white, ...
constexpr std::size_t whitePhotograph(std::size_t projector) {
  return projector * ownPhotographs;
}
/// ... one of its lights, ...
constexpr std::size_t lightPhotograph(std::size_t projector, std::size_t light) {
  return whitePhotograph(projector) + 1 + light;
}
/// ... and the first groups of all in white.
constexpr std::size_t groupsPhotograph(std::size_t projectors) {
  return projectors * ownPhotographs;
}

/// The levels that photographs show, and the photographs in terms of these alone.
struct ShownLevels {
  std::vector<std::vector<double>> drives;  // per projector
  std::vector<MosaicShot> what;
};
ShownLevels shownLevels(const MosaicPhotographs& photographs);

}  // namespace relucent::linearization
