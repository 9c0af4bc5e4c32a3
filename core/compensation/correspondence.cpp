// SPDX-License-Identifier: MIT
#include "relucent/compensation/correspondence.h"

#include <atomic>
#include <bit>

#include "relucent/base/error.h"
#include "relucent/base/parallel.h"

namespace relucent::compensation {

std::vector<std::int32_t> brightestCorrespondence(const transport::TransportMatrix& transport,
                                                  const CameraMask& usable,
                                                  const DirectLightSettings& settings) {
  constexpr float leastShare = 0.01f;
  const transport::NodeLayout& layout = transport.layout();
  const Rasters& projectors = transport.projectors();
  const std::size_t rows = transport.cameras().count();
  require(usable.size() == rows, "{} flags for {} camera pixels", usable.size(), rows);
  DirectLeaves rule(transport, settings);
  // The brightest so far, its light above its row: whoever comes first in whatever order, the brightest wins,
  // of equals the first row. Bits of positive floats sort as the floats do.
  std::vector<std::uint64_t> first(projectors.count(), 0);
  auto offer = [&](std::size_t pixel, float light, std::size_t row) {
    std::uint64_t bid =
        std::uint64_t{std::bit_cast<std::uint32_t>(light)} << 32 | ~static_cast<std::uint32_t>(row);
    std::atomic_ref<std::uint64_t> held(first[pixel]);
    std::uint64_t seen = held.load(std::memory_order_relaxed);
    while (seen < bid && !held.compare_exchange_weak(seen, bid, std::memory_order_relaxed)) {
    }
  };

  parallelFor(0, rows, 256, [&](std::size_t row) {
    if (!usable[row]) return;
    const transport::LeafRow leaves = transport.row(row);
    float most = rule.lookOf(leaves).light;
    rule.eachDirect(leaves, [&](std::size_t entry, const transport::Block& block) {
      float light = leaves.block(entry).sum() / static_cast<float>(block.count());
      if (!(light > 0.0f) || light < leastShare * most) return;
      auto projector = static_cast<std::size_t>(layout.node(leaves.column(entry)).projector);
      for (int y = block.y0; y < block.y1; ++y)
        for (int x = block.x0; x < block.x1; ++x)
          offer(projectors.offset(projector) + indexOf(projectors.size(projector), {x, y}), light, row);
    });
  });

  std::vector<std::int32_t> brightest(first.size(), -1);
  for (std::size_t pixel = 0; pixel < first.size(); ++pixel)
    if (first[pixel] != 0)
      brightest[pixel] = static_cast<std::int32_t>(~static_cast<std::uint32_t>(first[pixel]));
  return brightest;
}

ProjectorMask contentPixels(const std::vector<std::int32_t>& brightest, const Target& target) {
  ProjectorMask free(brightest.size(), 0);
  for (std::size_t j = 0; j < free.size(); ++j)
    free[j] = brightest[j] >= 0 && target.inside[static_cast<std::size_t>(brightest[j])];
  return free;
}

}  // namespace relucent::compensation
