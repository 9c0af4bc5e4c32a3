// SPDX-License-Identifier: MIT
#include "synthetic_transport.h"

#include <algorithm>
#include <cmath>

#include "relucent/base/random.h"

namespace relucent::benchmarks {
namespace {

transport::ColourBlock randomBlock(Random& random, float size) {
  transport::ColourBlock block;
  for (int i = 0; i < 9; ++i) block.data()[i] = size * random.uniformFloat() * (i % 4 == 0 ? 1.0f : 0.1f);
  return block;
}

}  // namespace

transport::BlockSparse syntheticLeaves(const SyntheticSettings& settings,
                                       const transport::NodeLayout& layout) {
  transport::BlockSparseBuilder builder(layout.count(), std::vector<float>(settings.camera.count(), 1.0f));
  Size projector = settings.projector;
  for (std::size_t row = 0; row < settings.camera.count(); ++row) {
    Random random{row};
    Pixel camera = pixelAt(settings.camera, row);
    int left =
        std::min(camera.x * projector.width / settings.camera.width, projector.width - settings.footprint);
    int top =
        std::min(camera.y * projector.height / settings.camera.height, projector.height - settings.footprint);
    for (int y = top; y < top + settings.footprint; ++y)
      for (int x = left; x < left + settings.footprint; ++x)
        builder.add(row, layout.index({0, 0, x, y}), randomBlock(random, 1.0f));

    for (int i = 0; i < settings.coarseNodes; ++i) {
      transport::Node node =
          layout.nodeOver(random.below(projector.count()), settings.finestCoarse + i % settings.coarseLevels);
      builder.add(row, layout.index(node), randomBlock(random, 0.05f));
    }
  }
  return builder.build();
}

transport::BlockSparse defocusedLeaves(const SyntheticSettings& settings, const DefocusSettings& defocus,
                                       const transport::NodeLayout& layout) {
  Size projector = settings.projector;
  std::size_t expected = settings.camera.count() * static_cast<std::size_t>(60 + settings.coarseNodes);
  transport::BlockSparseWriter writer(layout.count(), std::vector<float>(settings.camera.count(), 1.0f),
                                      expected);
  for (std::size_t row = 0; row < settings.camera.count(); ++row) {
    Random random{row, 17};
    Pixel camera = pixelAt(settings.camera, row);
    double across = static_cast<double>(camera.x) / settings.camera.width;
    double x = (camera.x + 0.5) * projector.width / settings.camera.width - 0.5;
    double y = (camera.y + 0.5) * projector.height / settings.camera.height - 0.5;
    auto addFootprint = [&](double cx, double cy, double sigma, double peak) {
      int reach = static_cast<int>(std::ceil(3.3 * sigma));
      for (int py = static_cast<int>(cy) - reach; py <= static_cast<int>(cy) + reach; ++py)
        for (int px = static_cast<int>(cx) - reach; px <= static_cast<int>(cx) + reach; ++px) {
          if (px < 0 || py < 0 || px >= projector.width || py >= projector.height) continue;
          double squared = ((px - cx) * (px - cx) + (py - cy) * (py - cy)) / (2.0 * sigma * sigma);
          if (squared > 5.3) continue;  // 0.5 % of the peak
          double value = peak * std::exp(-squared) * (0.9 + 0.2 * random.uniform());
          transport::ColourBlock block = transport::ColourBlock::Constant(static_cast<float>(0.1 * value));
          block.diagonal().setConstant(static_cast<float>(value));
          writer.add(layout.index({0, 0, px, py}), transport::codeOf(block, 1.0f / 32767.0f));
        }
    };
    addFootprint(x, y, defocus.sharpest + (defocus.softest - defocus.sharpest) * across, 0.8);
    if (row % 3 == 0) addFootprint(projector.width - 1 - x, y, 1.5, 0.05);
    for (int i = 0; i < settings.coarseNodes; ++i) {
      transport::Node node = layout.nodeOver(random.below(projector.count()), 3 + i % 4);
      writer.add(layout.index(node), transport::codeOf(randomBlock(random, 0.05f), 1.0f / 32767.0f));
    }
    writer.endRow();
  }
  return writer.build();
}

Stack randomStack(std::size_t pixels, std::uint64_t seed) {
  Random random{seed};
  Stack stack(3 * pixels);
  for (float& value : stack) value = random.uniformFloat();
  return stack;
}

}  // namespace relucent::benchmarks
