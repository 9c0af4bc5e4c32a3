// SPDX-License-Identifier: MIT
#include "compensation/direct_light.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/parallel.h"

namespace relucent {
namespace {

/// Where a camera pixel looks to in one projector.
struct Look {
  float light = 0.0f;  // of the brightest leaf, per projector pixel
  double x = 0.0, y = 0.0;
};

class DirectLeaves {
 public:
  DirectLeaves(const TransportMatrix& transport, const DirectLightSettings& settings)
      : leaves_(transport.leaves()), layout_(transport.layout()) {
    for (const Size& size : transport.projectors().sizes())
      reach_.push_back(std::max(3.0, settings.reach * std::max(size.width, size.height)));
  }

  /// Marks the direct leaves of a row.
  void mark(std::size_t row, std::vector<std::uint8_t>& direct) const {
    std::vector<Look> looks = looksOf(row);
    float most = 0.0f;
    for (const Look& look : looks) most = std::max(most, look.light);
    for (std::size_t entry = leaves_.rowBegin(row); entry < leaves_.rowBegin(row + 1); ++entry) {
      Node node = layout_.node(leaves_.column(entry));
      auto projector = static_cast<std::size_t>(node.projector);
      const Look& look = looks[projector];
      // Beside another projector's beam, what is left in this one's shadow is indirect.
      constexpr float leastShare = 0.1f;
      if (!(look.light > leastShare * most)) continue;
      Block block = layout_.block(node);
      double reach = reach_[projector];
      direct[entry] = std::abs(0.5 * (block.x0 + block.x1) - look.x) <= reach &&
                      std::abs(0.5 * (block.y0 + block.y1) - look.y) <= reach &&
                      std::max(block.x1 - block.x0, block.y1 - block.y0) <= reach;
    }
  }

 private:
  std::vector<Look> looksOf(std::size_t row) const {
    std::vector<Look> looks(reach_.size());
    for (std::size_t entry = leaves_.rowBegin(row); entry < leaves_.rowBegin(row + 1); ++entry) {
      Node node = layout_.node(leaves_.column(entry));
      Block block = layout_.block(node);
      float light = leaves_.block(row, entry).sum() / static_cast<float>(block.count());
      Look& look = looks[static_cast<std::size_t>(node.projector)];
      if (light > look.light) look = {light, 0.5 * (block.x0 + block.x1), 0.5 * (block.y0 + block.y1)};
    }
    return looks;
  }

  const BlockSparse& leaves_;
  const NodeLayout& layout_;
  std::vector<double> reach_;  // per projector, pixels
};

}  // namespace

std::vector<std::string> problems(const DirectLightSettings& settings) {
  if (settings.reach > 0.0 && settings.reach <= 1.0) return {};
  return {"the reach of direct light must lie between 0 and 1 of the projector's side"};
}

TransportMatrix directPart(const TransportMatrix& transport, const DirectLightSettings& settings,
                           Progress& progress) {
  auto wrong = problems(settings);
  require(wrong.empty(), "direct light settings: {}", fmt::join(wrong, "; "));
  const BlockSparse& leaves = transport.leaves();
  DirectLeaves rule(transport, settings);
  std::vector<std::uint8_t> direct(leaves.blocks(), 0);
  constexpr std::size_t rowsAtOnce = 4096;
  for (std::size_t begin = 0; begin < leaves.rows(); begin += rowsAtOnce) {
    progress.report(static_cast<double>(begin) / static_cast<double>(leaves.rows()));
    parallelFor(begin, std::min(begin + rowsAtOnce, leaves.rows()), 64,
                [&](std::size_t row) { rule.mark(row, direct); });
  }
  BlockSparse kept = leaves.filtered([&](std::size_t, std::size_t entry) { return direct[entry] != 0; });
  progress.report(1.0);
  return TransportMatrix(transport.cameras(), transport.projectors(), std::move(kept));
}

TransportMatrix defocusOnly(const TransportMatrix& transport, const DirectLightSettings& settings,
                            Progress& progress) {
  return rescaledToFloodlight(directPart(transport, settings, progress), transport.floodlight());
}

}  // namespace relucent
