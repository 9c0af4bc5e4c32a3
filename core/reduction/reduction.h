// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "relucent/hdr/hdr.h"
#include "relucent/rig/rig.h"

namespace relucent::reduction {

/// How a camera's photographs are made smaller before anything is measured with them: a part is cut out, and
/// every bin x bin pixels of it become one.
struct Reduction {
  Size camera;  // of the photographs that the camera delivers
  Pixel begin;  // of the part, pixels of the camera
  Size part;    // whole multiples of bin
  int bin = 1;
  double clip = 1.0;                           // signal of a sample that is full, as the camera delivers it
  std::array<hdr::ResponseCurve, 3> response;  // signal -> linear signal; the identity of a linear camera
  std::vector<std::uint32_t> defective;        // ascending 3 * pixel + channel: samples that are left out
  bool savesMemory = false;                    // smaller bins would suit the projection

  /// Of what remains.
  Size size() const { return {part.width / bin, part.height / bin}; }
  /// Every photograph stays as it is.
  bool isNothing() const { return bin == 1 && part == camera; }
  bool operator==(const Reduction&) const = default;
};

/// A camera of this size that stays as it is.
Reduction noReduction(Size camera);
/// The part of `camera` that holds the rectangle, on the grid of its bins, pixels that fill no bin left out.
/// Contract: the rectangle lies within the camera, bin is at most its shorter side.
Reduction reductionTo(Size camera, Pixel begin, Size part, int bin);

/// What the camera itself is like, where `reduced` is what was measured of it reduced: its samples are
/// noisier, and encoded by its response.
hdr::CameraModel wholeModel(const Reduction& reduction, const hdr::CameraModel& reduced);
/// Radiance of the reduced camera times this is that of the camera itself: response(clip), per channel.
std::array<float, 3> wholeFromReduced(const Reduction& reduction);

/// Photographs made smaller.
///   signal = mean over the sound samples s of the bin of response(s) / response(clip)
/// as a code of bits + log2(bin^2), rounded up, 16 at most; 16 where a response stretches the codes; floating
/// point stays that. One sample that is full makes the bin full: its mean would hide that. Samples weigh the
/// same whatever they hold: weights that follow a sample's own photon noise would favour the dark ones.
/// A bin without a sound sample takes all that it has. With a bin of 1 the samples stay as they are.
/// Variance: that of a sample over their number, and no more than a sample's own rounding over its square.
/// Source: core/reduction/README.md.
class Reducer {
 public:
  explicit Reducer(Reduction reduction);

  const Reduction& reduction() const { return reduction_; }
  /// Contract: a frame of the camera's size.
  rig::RawFrame operator()(const rig::RawFrame& frame) const;
  /// Bits of what comes of frames of that many.
  int bitsOf(int bits) const;
  /// What the radiance of the camera becomes: the mean over every bin's sound samples, over response(clip).
  image::Image radiance(const image::Image& linear) const;

 private:
  bool isDefective(std::size_t value) const { return !defective_.empty() && defective_[value] != 0; }

  Reduction reduction_;
  bool linear_ = true;
  std::array<double, 3> full_{};         // response(clip)
  std::vector<std::uint8_t> defective_;  // per value of the camera; empty: all are sound
};

}  // namespace relucent::reduction
