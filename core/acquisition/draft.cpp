// SPDX-License-Identifier: MIT
#include "relucent/acquisition/draft.h"

#include <algorithm>

#include "relucent/transport/coarsening.h"

namespace relucent::acquisition {
namespace {

constexpr std::size_t mostPixels = 160 * 120;
// Side of what is joined, camera pixels: from more than that only some count, or it would take seconds.
constexpr int mostJoined = 4;
// Of a row's leaves, relative to the flood: less is noise.
constexpr float leastSum = 0.1f;

/// Of the usable camera pixels, as many as tell enough of the joined ones.
CameraMask counted(const photography::References& references, int levels) {
  const int apart = std::max(1, (1 << levels) / mostJoined);
  CameraMask counts = references.usable;
  for (std::size_t camera = 0; camera < references.cameras.devices(); ++camera) {
    const Size size = references.cameras.size(camera);
    for (std::size_t pixel = 0; pixel < size.count(); ++pixel) {
      const Pixel at = pixelAt(size, pixel);
      if (at.x % apart != 0 || at.y % apart != 0) counts[references.cameras.offset(camera) + pixel] = 0;
    }
  }
  return counts;
}

/// Flood and variance of its photographs, all projectors and their channels summed.
void readFloods(transport::Acquisition& whole, const photography::References& references) {
  for (std::size_t projector = 0; projector < references.root.size(); ++projector)
    for (std::size_t row = 0; row < references.usable.size(); ++row) {
      Eigen::Map<Eigen::Vector3f>(&whole.flood[3 * row]) += references.root[projector][row].rowwise().sum();
      Eigen::Map<Eigen::Vector3f>(&whole.floodVariance[3 * row]) +=
          references.rootVariance[projector][row].rowwise().sum();
    }
}

}  // namespace

int draftCoarsening(const Rasters& cameras) {
  int levels = 0;
  while (transport::coarsened(cameras, levels).count() > mostPixels) ++levels;
  return levels;
}

transport::Draft draftOf(const multiplexing::Rows& rows, const DensePhotographs& photographs,
                         const photography::References& references, const transport::NodeLayout& layout,
                         int level) {
  const multiplexing::RowSettings model;
  const transport::Coarsening coarsening{draftCoarsening(references.cameras),
                                         draftCoarsening(references.cameras)};
  const CameraMask counts = counted(references, coarsening.cameras);
  auto blockOf = [&](std::size_t row, const multiplexing::Leaf& leaf) -> transport::ColourBlock {
    return leaf.light * rows.mixingOf(row)[multiplexing::kindOf(layout.node(leaf.node), model)];
  };
  auto leavesOf = [&](std::size_t row, const transport::AddLeaf& add) {
    // Mixings are learnt after the light they go with; what both give together is the flood.
    Eigen::Array3f sum = Eigen::Array3f::Zero();
    for (const multiplexing::Leaf& leaf : rows.leavesOf(row))
      sum += blockOf(row, leaf).rowwise().sum().array();
    const Eigen::Array3f scale = photographs.flood(row) / sum.max(leastSum);
    for (const multiplexing::Leaf& leaf : rows.leavesOf(row)) {
      transport::ColourBlock block = blockOf(row, leaf);
      block.array().colwise() *= scale;
      add(leaf.node, block);
    }
  };
  auto few = [&](const CameraStack& values) {
    return transport::joined(values, references.cameras, counts, coarsening.cameras);
  };
  transport::Acquisition whole;
  whole.flood.assign(3 * rows.size(), 0.0f);
  whole.floodVariance.assign(3 * rows.size(), 0.0f);
  readFloods(whole, references);

  transport::Draft draft;
  draft.level = level;
  draft.coarsening = coarsening.cameras;
  transport::Acquisition& small = draft.acquisition;
  small.transport = transport::coarsenedTransport(references.cameras, layout, counts, coarsening, leavesOf);
  small.black = few(references.black.radiance);
  small.blackVariance = few(references.black.variance);
  small.flood = few(whole.flood);
  small.floodVariance = few(whole.floodVariance);
  small.flagged = transport::joined(references.usable, references.cameras, coarsening.cameras);
  for (std::uint8_t& flag : small.flagged) flag = flag ? 0 : 1;
  return draft;
}

}  // namespace relucent::acquisition
