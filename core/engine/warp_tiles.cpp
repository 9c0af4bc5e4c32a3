// SPDX-License-Identifier: MIT
#include "relucent/engine/warp_tiles.h"

#include <algorithm>
#include <tuple>

#include "relucent/engine/camera_rectangle.h"

namespace relucent::engine {
namespace {

constexpr int largestSide = 32;
constexpr std::size_t enoughPixels = 12 * 1024;  // of content in a tile: 16 bytes each, in the cache

class Tiler {
 public:
  Tiler(const ContentWarp& warp, const Rasters& cameras, WarpTiles& to)
      : warp_(warp), cameras_(cameras), to_(to) {}

  /// Where footprints lie far apart, as at borders between views, a tile becomes four.
  void add(const CameraRectangle& place) {
    std::vector<std::uint32_t> pixels;
    const Size size = cameras_.size(place.camera);
    for (int y = place.from.y; y < place.to.y; ++y)
      for (int x = place.from.x; x < place.to.x; ++x) {
        const std::size_t pixel = cameras_.offset(place.camera) + indexOf(size, {x, y});
        if (pixel < warp_.footprints().size() && warp_.inside(pixel))
          pixels.push_back(static_cast<std::uint32_t>(pixel));
      }
    if (pixels.empty()) return;
    const WarpTiles::Tile tile = partOf(pixels);
    const Pixel middle{(place.from.x + place.to.x) / 2, (place.from.y + place.to.y) / 2};
    if (std::size_t{tile.width} * tile.height <= enoughPixels || pixels.size() <= 4 ||
        middle.x == place.from.x || middle.y == place.from.y)
      return append(tile, pixels);
    add({place.camera, place.from, middle});
    add({place.camera, {middle.x, place.from.y}, {place.to.x, middle.y}});
    add({place.camera, {place.from.x, middle.y}, {middle.x, place.to.y}});
    add({place.camera, middle, place.to});
  }

 private:
  WarpTiles::Tile partOf(const std::vector<std::uint32_t>& pixels) const {
    std::int32_t left = warp_.content().width, top = warp_.content().height, right = 0, bottom = 0;
    for (const std::uint32_t pixel : pixels) {
      const ContentWarp::Footprint& footprint = warp_.footprints()[pixel];
      left = std::min(left, footprint.x);
      top = std::min(top, footprint.y);
      right = std::max(right, footprint.x + footprint.width);
      bottom = std::max(bottom, footprint.y + footprint.height);
    }
    return {left, top, static_cast<std::uint32_t>(right - left), static_cast<std::uint32_t>(bottom - top),
            0,    0};
  }

  void append(WarpTiles::Tile tile, std::vector<std::uint32_t>& pixels) {
    const auto shapeOf = [this](std::uint32_t pixel) {
      const ContentWarp::Footprint& footprint = warp_.footprints()[pixel];
      return std::tuple(footprint.height, across(footprint), pixel);
    };
    std::sort(pixels.begin(), pixels.end(),
              [&](std::uint32_t a, std::uint32_t b) { return shapeOf(a) < shapeOf(b); });
    tile.begin = static_cast<std::uint32_t>(to_.footprints.size());
    for (const std::uint32_t pixel : pixels) append(tile, pixel);
    tile.end = static_cast<std::uint32_t>(to_.footprints.size());
    while (to_.footprints.size() % WarpTiles::together != 0) {
      const WarpTiles::Footprint again = to_.footprints[tile.begin];
      to_.footprints.push_back(again);
    }
    to_.mostPixels = std::max(to_.mostPixels, std::size_t{tile.width} * tile.height);
    to_.tiles.push_back(tile);
  }

  void append(const WarpTiles::Tile& tile, std::uint32_t pixel) {
    const ContentWarp::Footprint& from = warp_.footprints()[pixel];
    const std::uint16_t* weight = warp_.weights().data() + from.weight;
    to_.footprints.push_back({pixel,
                              static_cast<std::uint32_t>(from.y - tile.y) * tile.width +
                                  static_cast<std::uint32_t>(from.x - tile.x),
                              static_cast<std::uint32_t>(to_.weights.size() / WarpTiles::together),
                              across(from), from.height, from.scale});
    for (int line = 0; line < from.height; ++line, weight += from.width) {
      to_.weights.insert(to_.weights.end(), weight, weight + from.width);
      to_.weights.resize((to_.weights.size() + WarpTiles::together - 1) / WarpTiles::together *
                         WarpTiles::together);
    }
  }

  static std::uint16_t across(const ContentWarp::Footprint& footprint) {
    return static_cast<std::uint16_t>((footprint.width + WarpTiles::together - 1) / WarpTiles::together);
  }

  const ContentWarp& warp_;
  const Rasters& cameras_;
  WarpTiles& to_;
};

}  // namespace

WarpTiles::WarpTiles(const ContentWarp& warp, const Rasters& cameras) {
  Tiler tiler(warp, cameras, *this);
  for (std::size_t camera = 0; camera < cameras.devices(); ++camera) {
    const Size size = cameras.size(camera);
    for (int y = 0; y < size.height; y += largestSide)
      for (int x = 0; x < size.width; x += largestSide)
        tiler.add({camera,
                   {x, y},
                   {std::min(x + largestSide, size.width), std::min(y + largestSide, size.height)}});
  }
}

}  // namespace relucent::engine
