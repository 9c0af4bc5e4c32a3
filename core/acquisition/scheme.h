// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

#include "relucent/acquisition/settings.h"
#include "relucent/photography/references.h"

namespace relucent::acquisition {

/// The projector channels that a pattern is shown in at once.
using LitChannels = std::array<bool, 3>;

/// How the tree is measured: which children go on, what their measurement is corrected by, where the light of
/// the others is kept. All schemes share the quadtree and the colouring of conflicting blocks.
///
///                        adaptive                        sen
///   a child goes on      above max(relative F_i, noise)  above one radiance for all camera pixels
///   exposures            those that the threshold needs  all of them, every time
///   stored leaves        taken off each frame            not taken off
///   children and parent  reconciled by their variances   as measured
///   what does not go on  a leaf of its own, signed       added up in a leaf at the parent's level
///   flagged rows         measured again                  left as they are
///
/// Dense patterns need no tree, but for flagged rows if they are many: a tree of some rows alone takes some
/// 200 photographs, as many as all of the dense patterns.
/// Source: core/acquisition/README.md; Sen et al. 2005, adaptive multiplexed acquisition.
struct Scheme {
  std::vector<float> threshold;  // radiance, per camera pixel
  double noiseSigmas = 0.0;      // children below so many standard deviations do not go on either; 0: they do
  std::vector<float>
      tolerable;  // deviation of a frame that is good enough for the threshold, per camera pixel
  bool allExposures = false;
  bool subtractsLeaves = true;
  bool reconciles = true;
  bool restToParent = false;
  // Flagged camera pixels are measured again from this share of them on; above 1: never.
  double repairedFrom = 0.0;
  std::vector<LitChannels> lights;  // shown one after the other

  /// Whether any of a child's nine values is above what the scheme follows.
  bool follows(std::size_t row, const transport::ColourBlock& value,
               const transport::ColourBlock& variance) const;
};

Scheme schemeOf(const AcquisitionSettings& settings, const photography::References& references);

/// How a camera channel's light under `light` divides into projector channels: rows sum to 1 over the
/// channels that are lit, and are 0 elsewhere. One channel: all its own. White: as in the reference floods,
///   share(c, k) = M(c, k) / sum_k M(c, k),
/// or evenly, where the flood M of the camera pixel is not above its noise.
transport::ColourBlock channelShares(const LitChannels& light, const transport::ColourBlock& flood,
                                     const transport::ColourBlock& floodVariance);

}  // namespace relucent::acquisition
