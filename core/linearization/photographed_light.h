// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "relucent/base/progress.h"
#include "relucent/hdr/hdr.h"
#include "relucent/linearization/mosaic_photographs.h"
#include "relucent/linearization/response_fit.h"

namespace relucent::linearization {

/// Photographs of mosaics less black, at the values that all of them show and a projector lights.
struct PhotographedLight {
  MosaicOrder order;
  std::vector<std::size_t> at;                       // which values of the cameras' rasters
  std::vector<std::vector<double>> light, variance;  // [photograph][value]
  std::vector<std::vector<bool>> lit;                // [projector][value]: by more than noise could

  /// Of every projector's white.
  double whiteVariance(std::size_t value) const;
};

/// Of all photographs so far; while they are being taken, some projectors' own may be missing. Black is
/// interpolated in time. Throws: Cancelled.
PhotographedLight photographedLight(const MosaicPhotographs& photographs,
                                    const std::vector<hdr::CameraModel>& cameras, const Rasters& rasters,
                                    Progress& progress);

/// Products of the values of the cameras' rasters that `wanted` says.
LightProducts productsOf(const PhotographedLight& light, const std::function<bool(std::size_t)>& wanted);

}  // namespace relucent::linearization
