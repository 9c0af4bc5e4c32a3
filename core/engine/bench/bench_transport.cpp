// SPDX-License-Identifier: MIT
#include "relucent/engine/bench/bench_transport.h"

#include <algorithm>
#include <cmath>

#include "relucent/base/random.h"

namespace relucent::engine {
namespace {

constexpr int footprint = 4, coarseLeaves = 36, finestCoarse = 4, coarseLevels = 3;
// Camera pixels of so wide a square see the same nodes: light from afar arrives alike at neighbours.
constexpr int square = 16;
constexpr double overlap = 0.25;  // of the pictures of neighbouring projectors

}  // namespace

transport::TransportMatrix benchTransport(Size projector, Size camera) {
  return benchTransport(Rasters(projector), Rasters(camera));
}

transport::TransportMatrix benchTransport(const Rasters& projectors, const Rasters& cameras) {
  const transport::NodeLayout layout(projectors);
  const Size projector = projectors.size(0);
  const auto count = static_cast<int>(projectors.devices());
  // What all of them light, in the pixels of one: a projector begins every `pitch` of them.
  const double pitch = (1.0 - overlap) * projector.width, wall = projector.width + (count - 1) * pitch;
  transport::BlockSparseBuilder builder(layout.count(), std::vector<float>(cameras.count(), 1.0f));
  Random random{20071028};
  std::size_t device = 0;
  for (std::size_t row = 0; row < cameras.count(); ++row) {
    if (row == cameras.offset(device) + cameras.size(device).count()) ++device;
    const Size camera = cameras.size(device);
    Pixel place = pixelAt(camera, row - cameras.offset(device));
    const double across = (place.x + 0.5) * wall / camera.width - 0.5;
    double v = (place.y + 0.5) * projector.height / camera.height - 0.5;
    float reflectance = 0.3f + 0.6f * random.uniformFloat();
    for (int k = 0; k < count; ++k) {
      const double u = across - k * pitch;
      if (count > 1 && (u < -0.5 || u >= projector.width - 0.5)) continue;
      int left = std::clamp(static_cast<int>(u) - 1, 0, projector.width - footprint);
      int top = std::clamp(static_cast<int>(v) - 1, 0, projector.height - footprint);
      for (int y = top; y < top + footprint; ++y) {
        for (int x = left; x < left + footprint; ++x) {
          double distance = (x - u) * (x - u) + (y - v) * (y - v);
          float value = reflectance * static_cast<float>(std::exp(-distance / 2.0) / 6.3);
          transport::ColourBlock block = transport::ColourBlock::Constant(0.05f * value);
          block.diagonal().array() += 0.85f * value;
          builder.add(row, layout.index({k, 0, x, y}), block);
        }
      }
    }
    Random coarse{20071028, static_cast<std::uint64_t>(place.y / square * camera.width + place.x / square)};
    for (int i = 0; i < coarseLeaves; ++i) {
      const int from = count > 1 ? i % count : 0;
      int level = finestCoarse + static_cast<int>(coarse.below(coarseLevels));
      Size grid = layout.gridSize(static_cast<std::size_t>(from), std::min(level, layout.levels() - 1));
      transport::Node node{from, std::min(level, layout.levels() - 1),
                           static_cast<int>(coarse.below(static_cast<std::uint64_t>(grid.width))),
                           static_cast<int>(coarse.below(static_cast<std::uint64_t>(grid.height)))};
      builder.add(row, layout.index(node),
                  transport::ColourBlock::Identity() *
                      (0.004f * (coarse.uniformFloat() + 0.02f * random.uniformFloat())));
    }
  }
  return transport::TransportMatrix(cameras, projectors, builder.build());
}

}  // namespace relucent::engine
