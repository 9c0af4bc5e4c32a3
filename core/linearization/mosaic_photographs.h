// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "relucent/linearization/additivity.h"
#include "relucent/linearization/camera_noise.h"
#include "relucent/linearization/exposure_choice.h"
#include "relucent/linearization/linearization.h"
#include "relucent/linearization/response_fit.h"

namespace relucent::linearization {

/// Of all projectors, for people.
std::string namesOf(const rig::Rig& rig);

/// Part of a shot's pixels, for what needs no more of them than are enough: a row of pixels per camera.
class Thinning {
 public:
  explicit Thinning(const Rasters& cameras);

  rig::Shot of(const rig::Shot& shot) const;
  const Rasters& rasters() const { return thin_; }
  /// In which ninth of its camera's picture a pixel of rasters() was; ninths are counted over all cameras.
  std::size_t regionOf(std::size_t pixel) const { return regions_[pixel]; }
  std::size_t regions() const { return 9 * cameras_.devices(); }

 private:
  Rasters cameras_, thin_;
  std::size_t stride_;
  std::vector<std::size_t> regions_;
};

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

/// Shows the projectors' mosaics:
///  1. of each projector white and each of its nine lights alone; of all at once one group in white;
///  2. the levels of all projectors in the same photographs, of each projector three of each channel or two
///     and a full one that tells the lamp's power, from the highest down: with the exposures for flood
///     images, and with those for dim ones as soon as what has been photographed says that all are that dim;
///  3. white and black again.
/// `cameras` as far as they are known; `choice` from chooseExposures(), its photographs thinned;
/// `blackBefore`: black at the exposures for dim light and, for bright rooms, at others as well, thinned.
/// Throws: Error{input} if no camera sees one of a projector's channels.
MosaicPhotographs photographMosaics(rig::ShotTaker& shots, const std::vector<hdr::CameraModel>& cameras,
                                    const ExposureChoice& choice, rig::Shot blackBefore,
                                    const LinearizationSettings& settings, Progress& progress);

/// What the photographs say of a projector.
struct MosaicResult {
  ProjectorResponse response;
  Additivity additivity;
  std::vector<double> flicker;  // per camera: of the light between photographs, relative
  double unevenness = 0.0;      // of the response over the picture: the largest deviation of a part, of white
};
/// Per projector.
std::vector<MosaicResult> evaluate(const MosaicPhotographs& photographs,
                                   const std::vector<hdr::CameraModel>& cameras, const Thinning& thinning);

/// Drive levels in ascending order, without 0, exact codes of the projector.
std::vector<double> rampLevels(const LinearizationSettings& settings, int bits);

}  // namespace relucent::linearization
