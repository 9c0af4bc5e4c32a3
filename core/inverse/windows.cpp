// SPDX-License-Identifier: MIT
#include "relucent/inverse/windows.h"

#include "relucent/base/parallel.h"
#include "relucent/inverse/unmixing.h"

namespace relucent::inverse {

std::vector<Message> problems(const WindowSettings& settings) {
  std::vector<Message> found;
  if (settings.tile != 4 && settings.tile != 8)
    found.push_back(
        RELUCENT_ENGLISH_MESSAGE("inverse.tile-side-unsupported", "the side of a tile must be 4 or 8"));
  if (settings.rows < 1 || settings.rows > 1024)
    found.push_back(RELUCENT_ENGLISH_MESSAGE("inverse.window-size-out-of-range",
                                             "a window must have 1 to 1024 camera pixels"));
  if (!(settings.ridge > 0.0 && settings.ridge <= 100.0))
    found.push_back(
        RELUCENT_ENGLISH_MESSAGE("inverse.ridge-out-of-range", "the ridge must lie above 0 and at most 100"));
  return found;
}

Rasters WindowInverse::gridOf(const Rasters& projectors, int tile) {
  std::vector<Size> tiles;
  for (Size size : projectors.sizes())
    tiles.push_back({(size.width + tile - 1) / tile, (size.height + tile - 1) / tile});
  return Rasters(tiles);
}

std::size_t WindowInverse::bytes() const {
  return unmix_.size() * sizeof(float) + tileStart_.size() * sizeof(std::size_t) +
         row_.size() * sizeof(std::uint32_t) + weight_.size() * sizeof(std::int16_t) +
         scale_.size() * sizeof(float);
}

WindowArrays WindowInverse::view() const {
  return {&tiles_, tile_, unmix_.data(), tileStart_.data(), row_.data(), weight_.data(), scale_.data()};
}

ProjectorStack WindowInverse::apply(const CameraStack& cameraResidual) const {
  CameraStack light = unmixed(unmix_, cameraResidual);
  ProjectorStack projector(3 * projectors_.count());
  for (std::size_t device = 0; device < projectors_.devices(); ++device) {
    Size size = projectors_.size(device);
    Size grid = tiles_.size(device);
    parallelFor(0, grid.count(), 16, [&](std::size_t local) {
      constexpr std::size_t lanes = 16;  // pixels at once: a constant that compilers turn into vectors
      std::size_t tile = tiles_.offset(device) + local;
      auto pixels = static_cast<std::size_t>(tile_ * tile_);
      Pixel place = pixelAt(grid, local);
      for (std::size_t part = 0; part < pixels; part += lanes) {
        float sum[3][lanes] = {};
        for (std::size_t k = tileStart_[tile]; k < tileStart_[tile + 1]; ++k) {
          const float* in = &light[3 * static_cast<std::size_t>(row_[k])];
          const std::int16_t* code = &weight_[3 * pixels * k + part];
          for (std::size_t c = 0; c < 3; ++c)
            for (std::size_t i = 0; i < lanes; ++i)
              sum[c][i] += in[c] * static_cast<float>(code[c * pixels + i]);
        }
        for (std::size_t i = 0; i < lanes; ++i) {
          int x = place.x * tile_ + static_cast<int>(part + i) % tile_;
          int y = place.y * tile_ + static_cast<int>(part + i) / tile_;
          if (x >= size.width || y >= size.height) continue;
          float* out = &projector[3 * (projectors_.offset(device) + indexOf(size, {x, y}))];
          for (std::size_t c = 0; c < 3; ++c) out[c] = scale_[3 * tile + c] * sum[c][i];
        }
      }
    });
  }
  return projector;
}

}  // namespace relucent::inverse
