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

}  // namespace

transport::TransportMatrix benchTransport(Size projector, Size camera) {
  transport::NodeLayout layout{Rasters(projector)};
  transport::BlockSparseBuilder builder(layout.count(), std::vector<float>(camera.count(), 1.0f));
  Random random{20071028};
  for (std::size_t row = 0; row < camera.count(); ++row) {
    Pixel place = pixelAt(camera, row);
    double u = (place.x + 0.5) * projector.width / camera.width - 0.5;
    double v = (place.y + 0.5) * projector.height / camera.height - 0.5;
    float reflectance = 0.3f + 0.6f * random.uniformFloat();
    int left = std::clamp(static_cast<int>(u) - 1, 0, projector.width - footprint);
    int top = std::clamp(static_cast<int>(v) - 1, 0, projector.height - footprint);
    for (int y = top; y < top + footprint; ++y) {
      for (int x = left; x < left + footprint; ++x) {
        double distance = (x - u) * (x - u) + (y - v) * (y - v);
        float value = reflectance * static_cast<float>(std::exp(-distance / 2.0) / 6.3);
        transport::ColourBlock block = transport::ColourBlock::Constant(0.05f * value);
        block.diagonal().array() += 0.85f * value;
        builder.add(row, indexOf(projector, {x, y}), block);
      }
    }
    Random coarse{20071028, static_cast<std::uint64_t>(place.y / square * camera.width + place.x / square)};
    for (int i = 0; i < coarseLeaves; ++i) {
      int level = finestCoarse + static_cast<int>(coarse.below(coarseLevels));
      Size grid = layout.gridSize(0, std::min(level, layout.levels() - 1));
      transport::Node node{0, std::min(level, layout.levels() - 1),
                           static_cast<int>(coarse.below(static_cast<std::uint64_t>(grid.width))),
                           static_cast<int>(coarse.below(static_cast<std::uint64_t>(grid.height)))};
      builder.add(row, layout.index(node),
                  transport::ColourBlock::Identity() *
                      (0.004f * (coarse.uniformFloat() + 0.02f * random.uniformFloat())));
    }
  }
  return transport::TransportMatrix(Rasters(camera), Rasters(projector), builder.build());
}

}  // namespace relucent::engine
