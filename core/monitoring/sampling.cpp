// SPDX-License-Identifier: MIT
#include "relucent/monitoring/sampling.h"

#include <algorithm>
#include <cmath>

#include "relucent/base/require.h"

namespace relucent::monitoring {
namespace {

// Of a patch, which two pixels on each side only help to smooth and to differentiate.
constexpr int patchBorder = 2;
constexpr double leastUsableShare = 0.5;  // of a patch's pixels

struct PatchPlace {
  Pixel begin;
  Size size;
};

double usableShare(const PatchPlace& place, Size camera, const std::vector<std::uint8_t>& usable) {
  int count = 0;
  for (int y = 0; y < place.size.height; ++y)
    for (int x = 0; x < place.size.width; ++x)
      count += usable[indexOf(camera, {place.begin.x + x, place.begin.y + y})] != 0;
  return static_cast<double>(count) / static_cast<double>(place.size.count());
}

/// Patches whose inner parts tile the view.
std::vector<PatchPlace> tiledPatches(Size camera, int side) {
  std::vector<PatchPlace> places;
  const Size size{std::min(side, camera.width), std::min(side, camera.height)};
  const int stepX = std::max(1, size.width - 2 * patchBorder),
            stepY = std::max(1, size.height - 2 * patchBorder);
  for (int y = 0;; y += stepY) {
    const int top = std::min(y, camera.height - size.height);
    for (int x = 0;; x += stepX) {
      const int left = std::min(x, camera.width - size.width);
      places.push_back({{left, top}, size});
      if (left == camera.width - size.width) break;
    }
    if (top == camera.height - size.height) break;
  }
  return places;
}

/// In each of about `count` equal parts of the view the patch of most usable pixels.
std::vector<PatchPlace> sparsePatches(Size camera, const std::vector<std::uint8_t>& usable, int side,
                                      std::size_t count) {
  const double aspect = static_cast<double>(camera.width) / camera.height;
  const int rows = std::max(1, static_cast<int>(std::lround(std::sqrt(static_cast<double>(count) / aspect))));
  const int columns = std::max(1, static_cast<int>(count) / rows);
  std::vector<PatchPlace> places;
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      const int x0 = camera.width * column / columns, x1 = camera.width * (column + 1) / columns - side;
      const int y0 = camera.height * row / rows, y1 = camera.height * (row + 1) / rows - side;
      PatchPlace best{{(x0 + x1) / 2, (y0 + y1) / 2}, {side, side}};
      double most = usableShare(best, camera, usable);
      for (int y = y0; y <= y1 && most < 1.0; y += side)
        for (int x = x0; x <= x1 && most < 1.0; x += side) {
          const PatchPlace place{{x, y}, {side, side}};
          if (const double share = usableShare(place, camera, usable); share > most) {
            most = share;
            best = place;
          }
        }
      places.push_back(best);
    }
  return places;
}

}  // namespace

Sampling sampledPixels(Size camera, const std::vector<std::uint8_t>& usable,
                       const SamplingSettings& settings) {
  require(usable.size() == camera.count(), "{} pixels of {}", usable.size(), camera.count());
  const bool all = camera.count() <= settings.mostPixels;
  const std::size_t half = settings.mostPixels / 2;
  const auto side = static_cast<std::size_t>(settings.patch);
  std::vector<PatchPlace> places =
      all ? tiledPatches(camera, settings.patch)
          : sparsePatches(camera, usable, settings.patch, std::max<std::size_t>(1, half / (side * side)));
  std::erase_if(
      places, [&](const PatchPlace& place) { return usableShare(place, camera, usable) < leastUsableShare; });

  Sampling sampling;
  sampling.camera = camera;
  sampling.cells = {std::min(settings.cells.width, std::max(1, camera.width / 3)),
                    std::min(settings.cells.height, std::max(1, camera.height / 3))};
  const double step = all ? 1.0 : std::sqrt(static_cast<double>(camera.count()) / static_cast<double>(half));
  std::vector<std::uint32_t> even;
  for (double y = 0.5 * step; y < camera.height; y += step)
    for (double x = 0.5 * step; x < camera.width; x += step) {
      const std::size_t pixel = indexOf(camera, {static_cast<int>(x), static_cast<int>(y)});
      if (usable[pixel] != 0) even.push_back(static_cast<std::uint32_t>(pixel));
    }
  sampling.pixels = even;
  for (const PatchPlace& place : places)
    for (int y = 0; y < place.size.height; ++y)
      for (int x = 0; x < place.size.width; ++x)
        sampling.pixels.push_back(
            static_cast<std::uint32_t>(indexOf(camera, {place.begin.x + x, place.begin.y + y})));
  std::sort(sampling.pixels.begin(), sampling.pixels.end());
  sampling.pixels.erase(std::unique(sampling.pixels.begin(), sampling.pixels.end()), sampling.pixels.end());

  const auto sampleOf = [&](std::size_t pixel) {
    return static_cast<std::uint32_t>(
        std::lower_bound(sampling.pixels.begin(), sampling.pixels.end(), pixel) - sampling.pixels.begin());
  };
  for (std::uint32_t pixel : even) sampling.even.push_back(sampleOf(pixel));
  for (std::uint32_t pixel : sampling.pixels) {
    const Pixel at = pixelAt(camera, pixel);
    const int x = at.x * sampling.cells.width / camera.width,
              y = at.y * sampling.cells.height / camera.height;
    sampling.cell.push_back(static_cast<std::uint16_t>(indexOf(sampling.cells, {x, y})));
  }
  for (const PatchPlace& place : places) {
    Patch patch{place.size, {}};
    for (int y = 0; y < place.size.height; ++y)
      for (int x = 0; x < place.size.width; ++x)
        patch.samples.push_back(sampleOf(indexOf(camera, {place.begin.x + x, place.begin.y + y})));
    sampling.patches.push_back(std::move(patch));
  }
  return sampling;
}

}  // namespace relucent::monitoring
