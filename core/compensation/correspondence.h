// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "relucent/compensation/direct_light.h"
#include "relucent/compensation/target.h"

namespace relucent::compensation {

/// i*(j): for every projector pixel the usable camera pixel that it lights most, per pixel of a leaf's block,
/// sum over all channels; -1 where it lights none. Only direct leaves count (DirectLeaves): light that a
/// projector pixel sends outside the view returns as indirect light, which cannot be placed. Leaves below 1 %
/// of their row's brightest do not count.
std::vector<std::int32_t> brightestCorrespondence(const transport::TransportMatrix& transport,
                                                  const CameraMask& usable,
                                                  const DirectLightSettings& settings);

/// Per projector pixel: its brightest camera pixel lies within the content. The others are black.
ProjectorMask contentPixels(const std::vector<std::int32_t>& brightest, const Target& target);

/// The projector pixels of the content, and the camera pixels that they answer to.
struct ContentCorrespondence {
  std::vector<std::int32_t> brightest;  // i*(j) in the views that ask for something; -1: none sees j
  ProjectorMask free;                   // i*(j) lies within the content; the others are black
};
/// Views in which the content is placed together, that is the first one with all those in which it lies on
/// the surface, and each that has a quadrilateral of its own, have an i*(j) each; j belongs to the content
/// where one of these lies within it, and answers to the one of them that it lights most. Views of no weight
/// are not asked. `brightest`: i*(j) of all `usable` pixels, which answers where all views have a weight and
/// lie on the surface.
ContentCorrespondence contentCorrespondence(const transport::TransportMatrix& transport,
                                            const CameraMask& usable, const Target& target,
                                            const std::vector<std::int32_t>& brightest,
                                            const DirectLightSettings& settings);

/// contentCorrespondence() for any weights of the views, from what each of them sees alone: found once.
class ViewCorrespondence {
 public:
  ViewCorrespondence(const transport::TransportMatrix& transport, const CameraMask& usable,
                     const DirectLightSettings& settings);

  /// Of the target `inside`, `placements` and `viewWeight` are used.
  ContentCorrespondence of(const Target& target) const;

 private:
  /// Per camera: of every projector pixel the brightest camera pixel, below its light, see
  /// correspondence.cpp.
  std::vector<std::vector<std::uint64_t>> highest_;
};

}  // namespace relucent::compensation
