// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "relucent/rig/shot.h"

namespace relucent::linearization {

/// Part of a shot's pixels, for what needs no more of them than are enough: a row of pixels per camera.
class Thinning {
 public:
  /// Ninths of its picture.
  static constexpr std::size_t regionsOfCamera = 9;

  explicit Thinning(const Rasters& cameras);

  rig::Shot of(const rig::Shot& shot) const;
  const Rasters& rasters() const { return thin_; }
  /// In which region of its camera's picture a pixel of rasters() was; counted over all cameras.
  std::size_t regionOf(std::size_t pixel) const { return regions_[pixel]; }
  std::size_t regions() const { return regionsOfCamera * cameras_.devices(); }

 private:
  Rasters cameras_, thin_;
  std::size_t stride_;
  std::vector<std::size_t> regions_;
};

}  // namespace relucent::linearization
