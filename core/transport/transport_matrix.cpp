// SPDX-License-Identifier: MIT
#include "relucent/transport/transport_matrix.h"

#include <algorithm>

#include "relucent/base/error.h"
#include "relucent/base/parallel.h"
#include "relucent/transport/shared_colours.h"
#include "relucent/transport/shared_fate.h"

namespace relucent::transport {

TransportMatrix::TransportMatrix(Rasters cameras, Rasters projectors, BlockSparse leaves)
    : TransportMatrix(std::move(cameras), std::move(projectors), std::move(leaves), {}) {}

TransportMatrix::TransportMatrix(Rasters cameras, Rasters projectors, BlockSparse own, LeafGroups groups)
    : cameras_(std::move(cameras)),
      layout_(std::move(projectors)),
      own_(std::move(own)),
      groups_(std::move(groups)) {
  require(own_.rows() == cameras_.count() && own_.columns() == layout_.count(),
          "{} x {} leaves for {} camera pixels and {} nodes", own_.rows(), own_.columns(), cameras_.count(),
          layout_.count());
  if (groups_.empty()) return;
  const std::size_t devices = layout_.projectors().devices();
  require(own_.sharedColours() && own_.sharedColours()->count == 2 * devices &&
              groups_.leaves().sharedColours() && groups_.leaves().columns() == layout_.count() &&
              groups_.groupsOfPixels().size() == cameras_.count() * devices,
          "groups of {} memberships for {} camera pixels and {} projectors", groups_.groupsOfPixels().size(),
          cameras_.count(), devices);
}

CameraStack TransportMatrix::apply(const ProjectorStack& projector) const {
  const NodeStack means = layout_.means(projector);
  Stack camera = own_.multiply(means);
  groups_.addLight(own_, means, camera);
  return CameraStack(std::move(camera));
}

ProjectorStack TransportMatrix::applyTransposed(const CameraStack& camera) const {
  Stack nodes = own_.multiplyTransposed(camera);
  groups_.addAdjoint(own_, camera, nodes);
  return layout_.meansAdjoint(NodeStack(std::move(nodes)));
}

CameraStack TransportMatrix::floodlight() const {
  const Stack white(3 * layout_.count(), 1.0f);
  Stack camera = own_.multiply(white);
  groups_.addLight(own_, white, camera);
  return CameraStack(std::move(camera));
}

std::vector<ColourBlock> TransportMatrix::rowSums() const {
  std::vector<ColourBlock> sums(own_.rows(), ColourBlock::Zero());
  const std::vector<std::array<float, 3>> ofGroups = groups_.sums();
  const LeafGroups none;
  parallelFor(0, own_.rows(), 256, [&](std::size_t row) {
    const LeafRow own(own_, none, row, projectors().devices());
    std::vector<Eigen::Array3f> factors(own.colourings(), Eigen::Array3f::Zero());
    own.eachFactor([&](std::size_t, std::size_t k, const Eigen::Array3f& factor) { factors[k] += factor; });
    for (std::size_t projector = 0; !groups_.empty() && projector < projectors().devices(); ++projector)
      if (const std::uint32_t group = groups_.groupOf(row, projector); group != LeafGroups::none)
        factors[farKind(projector)] += Eigen::Map<const Eigen::Array3f>(ofGroups[group].data());
    for (std::size_t k = 0; k < factors.size(); ++k)
      sums[row] += own.colours(k) * factors[k].matrix().asDiagonal();
  });
  return sums;
}

std::vector<std::vector<ColourBlock>> TransportMatrix::rowSumsOfProjectors() const {
  const std::size_t devices = projectors().devices();
  std::vector<std::vector<ColourBlock>> sums(devices,
                                             std::vector<ColourBlock>(own_.rows(), ColourBlock::Zero()));
  parallelFor(0, own_.rows(), 256, [&](std::size_t row_) {
    const LeafRow leaves = row(row_);
    const std::size_t kinds = leaves.colourings();
    std::vector<Eigen::Array3f> factors(devices * kinds, Eigen::Array3f::Zero());
    NodeCursor nodeAt(layout());
    leaves.eachFactor([&](std::size_t entry, std::size_t k, const Eigen::Array3f& factor) {
      factors[static_cast<std::size_t>(nodeAt(leaves.column(entry)).projector) * kinds + k] += factor;
    });
    for (std::size_t i = 0; i < factors.size(); ++i)
      sums[i / kinds][row_] += leaves.colours(i % kinds) * factors[i].matrix().asDiagonal();
  });
  return sums;
}

TransportMatrix TransportMatrix::flattened() const {
  if (groups_.empty()) return *this;
  std::size_t leaves = 0;
  for (std::size_t pixel = 0; pixel < own_.rows(); ++pixel) leaves += row(pixel).size();
  SharedColourWriter writer(own_.columns(), own_.rows(), *own_.sharedColours(), leaves);
  for (std::size_t pixel = 0; pixel < own_.rows(); ++pixel) writer.add(row(pixel).shared());
  return {cameras_, projectors(), writer.build()};
}

TransportMatrix TransportMatrix::filtered(const KeepLeaves& keep) const {
  if (!groups_.empty()) return filteredSharing(keep);
  std::vector<std::uint8_t> kept(own_.blocks());
  parallelChunks(0, own_.rows(), 64, [&](std::size_t, std::size_t begin, std::size_t end) {
    std::vector<std::uint8_t> ofRow;
    for (std::size_t pixel = begin; pixel < end; ++pixel) {
      const LeafRow leaves = row(pixel);
      ofRow.assign(leaves.size(), 0);
      keep(pixel, leaves, ofRow);
      std::ranges::copy(ofRow, kept.begin() + static_cast<std::ptrdiff_t>(own_.rowBegin(pixel)));
    }
  });
  return {cameras_, projectors(), own_.filtered(kept)};
}

TransportMatrix TransportMatrix::filteredSharing(const KeepLeaves& keep) const {
  const std::size_t pixels = own_.rows(), devices = projectors().devices();
  std::vector<std::vector<std::uint8_t>> kept(pixels);
  SharedFate fate(groups_);
  parallelChunks(0, pixels, 64, [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t pixel = begin; pixel < end; ++pixel) {
      const LeafRow leaves = row(pixel);
      kept[pixel].assign(leaves.size(), 0);
      keep(pixel, leaves, kept[pixel]);
      fate.look(leaves, kept[pixel], devices);
    }
  });
  const std::vector<std::uint8_t> stays = fate.staying();

  SharedColourWriter writer(own_.columns(), pixels, *own_.sharedColours(), own_.blocks());
  for (std::size_t pixel = 0; pixel < pixels; ++pixel) {
    const LeafRow leaves = row(pixel);
    leaves.visitShared(groups_, devices, [&](std::size_t entry, std::size_t leaf) {
      if (stays[leaf] != 0) kept[pixel][entry] = 0;
    });
    const SharedColourRow all = leaves.shared();
    SharedColourRow own;
    own.mixing = all.mixing;
    for (std::size_t entry = 0; entry < all.column.size(); ++entry) {
      if (kept[pixel][entry] == 0) continue;
      own.column.push_back(all.column[entry]);
      own.factor.push_back(all.factor[entry]);
    }
    writer.add(own);
    std::vector<std::uint8_t>().swap(kept[pixel]);
  }
  if (std::ranges::find(stays, 1) == stays.end()) return {cameras_, projectors(), writer.build()};
  return {cameras_, projectors(), writer.build(), groups_.filtered(stays)};
}

TransportMatrix TransportMatrix::withRowsScaled(const Stack& factor) const {
  return {cameras_, projectors(), own_.withRowsScaled(factor), groups_};
}

TransportMatrix TransportMatrix::withLightScaled(const LightFactor& factor) const {
  return withColoursScaled(nearAndFar(layout_, 1),
                           [&](std::size_t pixel, std::size_t kind) { return factor(pixel, kind / 2); });
}

TransportMatrix TransportMatrix::withColoursScaled(const ColumnKinds& kinds,
                                                   const BlockSparse::BlockFactor& factor) const& {
  return {cameras_, projectors(), own_.withBlocksScaled(kinds, factor), groups_};
}

TransportMatrix TransportMatrix::withColoursScaled(const ColumnKinds& kinds,
                                                   const BlockSparse::BlockFactor& factor) && {
  own_ = std::move(own_).withBlocksScaled(kinds, factor);
  return std::move(*this);
}

bool TransportMatrix::operator==(const TransportMatrix& other) const {
  return cameras_ == other.cameras_ && projectors() == other.projectors() && own_ == other.own_ &&
         groups_ == other.groups_;
}

TransportMatrix rescaledToFloodlight(const TransportMatrix& transport, const CameraStack& flood,
                                     float floor) {
  Stack now = transport.floodlight();
  require(flood.size() == now.size(), "a flood image of {} values for {}", flood.size(), now.size());
  Stack factor(now.size(), 1.0f);
  for (std::size_t i = 0; i < now.size(); ++i)
    if (now[i] > floor && now[i] > 0.0f) factor[i] = std::max(0.0f, flood[i]) / now[i];
  return transport.withRowsScaled(factor);
}

}  // namespace relucent::transport
