// SPDX-License-Identifier: MIT
#include "synthetic_transport.h"

#include <algorithm>

#include "base/random.h"

namespace relucent::benchmarks {
namespace {

ColourBlock randomBlock(Random& random, float size) {
  ColourBlock block;
  for (int i = 0; i < 9; ++i) block.data()[i] = size * random.uniformFloat() * (i % 4 == 0 ? 1.0f : 0.1f);
  return block;
}

}  // namespace

BlockSparse syntheticLeaves(const SyntheticSettings& settings, const NodeLayout& layout) {
  BlockSparseBuilder builder(layout.count(), std::vector<float>(settings.camera.count(), 1.0f));
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
      Node node = layout.nodeOver(random.below(projector.count()), 3 + i % 4);
      builder.add(row, layout.index(node), randomBlock(random, 0.05f));
    }
  }
  return builder.build();
}

Stack randomStack(std::size_t pixels, std::uint64_t seed) {
  Random random{seed};
  Stack stack(3 * pixels);
  for (float& value : stack) value = random.uniformFloat();
  return stack;
}

}  // namespace relucent::benchmarks
