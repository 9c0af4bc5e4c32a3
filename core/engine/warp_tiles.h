// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "relucent/base/raster.h"
#include "relucent/engine/content_warp.h"

namespace relucent::engine {

/// A ContentWarp as the processor reads it. Camera pixels that lie beside each other make a tile; its part of
/// the content becomes linear light once, though several camera pixels read each content pixel. Footprints of
/// a tile are sorted by shape, so that loops over their lines end where the former ones did.
struct WarpTiles {
  static constexpr std::size_t together = 4;  // content pixels, and camera pixels

  /// A camera pixel's rectangle within its tile's part of the content. Lines are filled up to multiples of
  /// `together` by weights of 0.
  struct Footprint {
    std::uint32_t pixel = 0;
    std::uint32_t first = 0;              // pixel of the part
    std::uint32_t weight = 0;             // the first one's, in units of `together`
    std::uint16_t across = 0, lines = 0;  // across: in units of `together`
    float scale = 0.0f;                   // weight = scale * code
  };
  /// Its part of the content, and its footprints. Behind them its first one again, up to a multiple of
  /// `together`.
  struct Tile {
    std::int32_t x = 0, y = 0;
    std::uint32_t width = 0, height = 0;
    std::uint32_t begin = 0, end = 0;
  };

  WarpTiles() = default;
  /// `cameras`: whose pixels the warp's footprints are.
  WarpTiles(const ContentWarp& warp, const Rasters& cameras);

  std::vector<Tile> tiles;
  std::vector<Footprint> footprints;
  std::vector<std::uint16_t> weights;
  /// The most pixels of any tile's part; as many as `together` more may be read, with weight 0.
  std::size_t mostPixels = 0;
};

}  // namespace relucent::engine
