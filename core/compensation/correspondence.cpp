// SPDX-License-Identifier: MIT
#include "relucent/compensation/correspondence.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <functional>
#include <utility>

#include "relucent/base/error.h"
#include "relucent/base/parallel.h"

namespace relucent::compensation {
namespace {

/// A camera pixel's light from a projector pixel, above the pixel's number: the brightest is the largest, of
/// equals the first. Bits of positive floats sort as the floats do. 0: none.
using Bid = std::uint64_t;

Bid bidOf(float light, std::size_t row) {
  return Bid{std::bit_cast<std::uint32_t>(light)} << 32 | ~static_cast<std::uint32_t>(row);
}
std::int32_t rowOf(Bid bid) {
  return bid == 0 ? -1 : static_cast<std::int32_t>(~static_cast<std::uint32_t>(bid));
}

/// Of every projector pixel the highest one. Whoever comes first in whatever order, it wins.
std::vector<Bid> highestBids(const transport::TransportMatrix& transport, const CameraMask& usable,
                             const DirectLightSettings& settings) {
  constexpr float leastShare = 0.01f;
  const Rasters& projectors = transport.projectors();
  const std::size_t rows = transport.cameras().count();
  require(usable.size() == rows, "{} flags for {} camera pixels", usable.size(), rows);
  DirectLeaves rule(transport, settings);
  std::vector<Bid> highest(projectors.count(), 0);
  auto offer = [&](std::size_t pixel, float light, std::size_t row) {
    const Bid bid = bidOf(light, row);
    std::atomic_ref<Bid> held(highest[pixel]);
    Bid seen = held.load(std::memory_order_relaxed);
    while (seen < bid && !held.compare_exchange_weak(seen, bid, std::memory_order_relaxed)) {
    }
  };

  parallelFor(0, rows, 256, [&](std::size_t row) {
    if (!usable[row]) return;
    const LookedAtRow leaves(rule, transport.row(row));
    const float most = leaves.mostLight();
    leaves.eachDirect([&](std::size_t, const LookedAtRow::Leaf& leaf) {
      if (!(leaf.light > 0.0f) || leaf.light < leastShare * most) return;
      for (int y = leaf.block.y0; y < leaf.block.y1; ++y)
        for (int x = leaf.block.x0; x < leaf.block.x1; ++x)
          offer(projectors.offset(leaf.projector) + indexOf(projectors.size(leaf.projector), {x, y}),
                leaf.light, row);
    });
  });

  return highest;
}

/// The views in which the content is placed together, and ask for something: a mask of cameras each.
std::vector<std::vector<bool>> placedTogether(const Target& target) {
  std::vector<std::vector<bool>> groups(1, std::vector<bool>(target.viewWeight.size()));
  for (std::size_t camera = 0; camera < target.viewWeight.size(); ++camera) {
    if (!(target.viewWeight[camera] > 0.0f)) continue;
    const bool isOwn = camera > 0 && target.placements[camera].has_value();
    if (isOwn) groups.emplace_back(target.viewWeight.size());
    (isOwn ? groups.back() : groups.front())[camera] = true;
  }
  return groups;
}

/// Of what the groups bid for every projector pixel, the content's and then the highest.
template <typename BidsOf>
ContentCorrespondence answered(const std::vector<std::vector<bool>>& groups, const Target& target,
                               std::size_t pixels, const BidsOf& bidsOf) {
  ContentCorrespondence content{std::vector<std::int32_t>(pixels, -1), ProjectorMask(pixels, 0)};
  std::vector<Bid> answers(pixels, 0);
  for (const std::vector<bool>& group : groups) {
    const std::vector<Bid> highest = bidsOf(group);
    for (std::size_t j = 0; j < pixels; ++j) {
      const std::int32_t row = rowOf(highest[j]);
      if (row < 0) continue;
      const bool inside = isCovered(target, static_cast<std::size_t>(row));
      if (std::pair(inside, highest[j]) < std::pair(content.free[j] != 0, answers[j])) continue;
      content.brightest[j] = row;
      content.free[j] = inside;
      answers[j] = highest[j];
    }
  }
  return content;
}

}  // namespace

std::vector<std::int32_t> brightestCorrespondence(const transport::TransportMatrix& transport,
                                                  const CameraMask& usable,
                                                  const DirectLightSettings& settings) {
  const std::vector<Bid> highest = highestBids(transport, usable, settings);
  std::vector<std::int32_t> brightest(highest.size());
  std::ranges::transform(highest, brightest.begin(), rowOf);
  return brightest;
}

ContentCorrespondence contentCorrespondence(const transport::TransportMatrix& transport,
                                            const CameraMask& usable, const Target& target,
                                            const std::vector<std::int32_t>& brightest,
                                            const DirectLightSettings& settings) {
  const std::vector<std::vector<bool>> groups = placedTogether(target);
  if (groups.size() == 1 && std::ranges::all_of(groups.front(), std::identity()))
    return {brightest, contentPixels(brightest, target)};

  const Rasters& cameras = transport.cameras();
  return answered(groups, target, brightest.size(), [&](const std::vector<bool>& group) {
    CameraMask asked(usable.size(), 0);
    for (std::size_t camera = 0; camera < cameras.devices(); ++camera)
      if (group[camera])
        std::copy_n(usable.begin() + static_cast<std::ptrdiff_t>(cameras.offset(camera)),
                    cameras.size(camera).count(),
                    asked.begin() + static_cast<std::ptrdiff_t>(cameras.offset(camera)));
    return highestBids(transport, asked, settings);
  });
}

ViewCorrespondence::ViewCorrespondence(const transport::TransportMatrix& transport, const CameraMask& usable,
                                       const DirectLightSettings& settings) {
  const Rasters& cameras = transport.cameras();
  for (std::size_t camera = 0; camera < cameras.devices(); ++camera) {
    CameraMask asked(usable.size(), 0);
    const auto first = static_cast<std::ptrdiff_t>(cameras.offset(camera));
    std::copy_n(usable.begin() + first, cameras.size(camera).count(), asked.begin() + first);
    highest_.push_back(highestBids(transport, asked, settings));
  }
}

ContentCorrespondence ViewCorrespondence::of(const Target& target) const {
  const std::size_t pixels = highest_.front().size();
  return answered(placedTogether(target), target, pixels, [&](const std::vector<bool>& group) {
    std::vector<Bid> highest(pixels, 0);
    for (std::size_t camera = 0; camera < highest_.size(); ++camera) {
      if (!group[camera]) continue;
      parallelFor(0, pixels, 16384,
                  [&](std::size_t j) { highest[j] = std::max(highest[j], highest_[camera][j]); });
    }
    return highest;
  });
}

ProjectorMask contentPixels(const std::vector<std::int32_t>& brightest, const Target& target) {
  ProjectorMask free(brightest.size(), 0);
  for (std::size_t j = 0; j < free.size(); ++j)
    free[j] = brightest[j] >= 0 && isCovered(target, static_cast<std::size_t>(brightest[j]));
  return free;
}

}  // namespace relucent::compensation
