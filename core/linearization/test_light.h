// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

#include "relucent/hdr/hdr.h"
#include "relucent/rig/shot.h"

namespace relucent::linearization {

using Drive = std::array<float, 3>;

/// Every pixel of every projector at `drive`.
std::vector<image::Image> evenPatterns(const rig::Rig& rig, Drive drive);
/// Every pixel of one projector at `drive`, the others black.
std::vector<image::Image> evenPatterns(const rig::Rig& rig, std::size_t projector, Drive drive);

/// Shows the first of these on all projectors, one after the other.
void showEven(rig::Rig& rig, Drive drive);

/// Takes shots at the chosen exposures and merges them.
class LightMeter {
 public:
  LightMeter(rig::ShotTaker& shots, std::vector<hdr::CameraModel> cameras, std::vector<double> exposures);

  const rig::Rig& rig() const { return shots_.rig(); }
  hdr::HdrFrame measure(const std::vector<image::Image>& encodedPatterns, const Progress& progress) const;

 private:
  rig::ShotTaker& shots_;
  std::vector<hdr::CameraModel> cameras_;
  std::vector<double> exposures_;
  Rasters rasters_;
};

/// A fixed weighted sum over well-lit values: the amount of a light in a frame.
///   sum_i a_i L_i,   a_i = D_i / variance(D_i) where D = lit - black is above a tenth of its 99th percentile
/// Linear in the frame, so it may be applied before differences are taken.
class LightWeights {
 public:
  LightWeights() = default;
  LightWeights(const hdr::HdrFrame& lit, const hdr::HdrFrame& black);

  /// No value is above the limit: the cameras do not see this light.
  bool empty() const { return terms_.empty(); }
  double of(const hdr::HdrFrame& frame) const;
  double varianceOf(const hdr::HdrFrame& frame) const;

 private:
  struct Term {
    std::size_t at;
    double weight;
  };
  std::vector<Term> terms_;
};

}  // namespace relucent::linearization
