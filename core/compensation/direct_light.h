// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "relucent/base/progress.h"
#include "relucent/transport/transport_matrix.h"

namespace relucent::compensation {

struct DirectLightSettings {
  /// Distance from a camera pixel's brightest projector pixel within which light counts as direct, as a share
  /// of the projector's larger side; at least three pixels. A heuristic: wide
  /// enough for defocus, narrow compared with the smooth patterns of diffuse interreflection.
  double reach = 1.0 / 32.0;
};
std::vector<Message> problems(const DirectLightSettings& settings);

/// Where a camera pixel looks to.
struct DirectLook {
  std::int32_t projectorPixel = -1;  // centre of the brightest leaf's block; -1: nothing lights it
  float light = 0.0f;  // value of that leaf per projector pixel of its block, sum over the channels
  float share = 0.0f;  // share of the pixel's flood image that is direct
};

/// A camera pixel counts as directly lit if at least this share of its light is direct: of uniform indirect
/// light 0.5 % comes from within the reach.
inline constexpr double leastDirectShare = 0.1;

/// Decides which leaves of a row of T are direct, without building a matrix:
///  1. Per camera pixel and projector the leaf that is brightest per projector pixel of its block (sum over
///     the channels); the centre of its block is where the camera pixel looks to in that projector. Of
///     several projectors only those count that light it a tenth as much as the brightest does.
///  2. A leaf is direct if its block's centre is no further from there than the reach, along x and along y,
///     and its block no wider than the reach. Light over a wider area comes from no single place: indirect;
///     but of a T that was measured in blocks alone, the reach is at least one of the finest,
///     up to a sixth of the projector's side.
/// Used by directPart() and wherever it matters where the projection itself falls.
class DirectLeaves {
 public:
  /// T must outlive this object, and rows are T's.
  DirectLeaves(const transport::TransportMatrix& transport, const DirectLightSettings& settings);

  /// Calls visit(entry, block) for the direct leaves of a row.
  template <typename Visit>
  void eachDirect(const transport::LeafRow& leaves, const Visit& visit) const;

  DirectLook lookOf(const transport::LeafRow& leaves) const;

 private:
  friend class LookedAtRow;

  const transport::NodeLayout& layout_;
  std::vector<double> reach_;  // per projector, pixels
};

/// A row of T whose leaves were looked at once, for whoever asks several things of it.
class LookedAtRow {
 public:
  struct Leaf {
    transport::Block block;
    std::size_t projector = 0;
    float sum = 0.0f;    // over the channels of both
    float light = 0.0f;  // of it, per projector pixel of the block
  };

  LookedAtRow(const DirectLeaves& rule, const transport::LeafRow& leaves);

  DirectLook look() const;
  /// Of that alone `light`.
  float mostLight() const;
  /// Calls visit(entry, leaf) for the direct leaves.
  template <typename Visit>
  void eachDirect(const Visit& visit) const {
    // Where another projector lights a pixel directly, light of this one in its own shadow is indirect.
    constexpr float leastShare = 0.1f;
    const float most = mostLight();
    for (std::size_t entry = 0; entry < leaves_.size(); ++entry) {
      const Leaf& leaf = leaves_[entry];
      const Place& place = places_[leaf.projector];
      if (!(place.light > leastShare * most)) continue;
      const transport::Block& block = leaf.block;
      const double reach = rule_.reach_[leaf.projector];
      if (std::abs(0.5 * (block.x0 + block.x1) - place.x) <= reach &&
          std::abs(0.5 * (block.y0 + block.y1) - place.y) <= reach &&
          std::max(block.x1 - block.x0, block.y1 - block.y0) <= reach)
        visit(entry, leaf);
    }
  }

 private:
  /// Where a camera pixel looks to in one projector.
  struct Place {
    float light = 0.0f;  // of the brightest leaf, per projector pixel
    double x = 0.0, y = 0.0;
  };

  const DirectLeaves& rule_;
  std::vector<Leaf> leaves_;
  std::vector<Place> places_;
};

template <typename Visit>
void DirectLeaves::eachDirect(const transport::LeafRow& leaves, const Visit& visit) const {
  LookedAtRow(*this, leaves).eachDirect([&](std::size_t entry, const LookedAtRow::Leaf& leaf) {
    visit(entry, leaf.block);
  });
}

/// The direct part of T: the leaves that DirectLeaves names.
/// The rest, T - direct, is indirect: interreflections, scattering, caustics; and light on a second direct
/// path to the camera pixel, through glass or past a depth edge, which T does not distinguish from those.
/// Law: direct + indirect = T, leaf by leaf.  Source: core/compensation/README.md.
/// Throws: Cancelled.
transport::TransportMatrix directPart(const transport::TransportMatrix& transport,
                                      const DirectLightSettings& settings, Progress& progress);

/// For every camera pixel the data on which directPart() decides, without building it.
std::vector<DirectLook> directLooks(const transport::TransportMatrix& transport,
                                    const DirectLightSettings& settings, Progress& progress);

/// Per look: enough of its light is direct.
CameraMask directlyLit(const std::vector<DirectLook>& looks, double leastShare = leastDirectShare);

/// directlyLit() of a T of which only the `changed` rows are others than in `former`, of which `lit` was
/// known.
CameraMask renewedDirectlyLit(CameraMask lit, const transport::TransportMatrix& former,
                              const transport::TransportMatrix& transport, const CameraMask& changed);

/// Transport of a model with defocus but without indirect light: the direct part, every row scaled to the
/// whole flood image.
/// Rows without direct light are empty.
transport::TransportMatrix defocusOnly(const transport::TransportMatrix& transport,
                                       const DirectLightSettings& settings, Progress& progress);

}  // namespace relucent::compensation
