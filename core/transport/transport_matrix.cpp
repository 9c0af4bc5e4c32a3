// SPDX-License-Identifier: MIT
#include "transport/transport_matrix.h"

#include <algorithm>

#include "base/error.h"
#include "base/parallel.h"

namespace relucent {

TransportMatrix::TransportMatrix(Rasters cameras, Rasters projectors, BlockSparse leaves)
    : cameras_(std::move(cameras)), layout_(std::move(projectors)), leaves_(std::move(leaves)) {
  require(leaves_.rows() == cameras_.count() && leaves_.columns() == layout_.count(),
          "{} x {} leaves for {} camera pixels and {} nodes", leaves_.rows(), leaves_.columns(),
          cameras_.count(), layout_.count());
}

Stack TransportMatrix::apply(const Stack& projector) const {
  return leaves_.multiply(layout_.means(projector));
}

Stack TransportMatrix::applyTransposed(const Stack& camera) const {
  return layout_.meansAdjoint(leaves_.multiplyTransposed(camera));
}

Stack TransportMatrix::floodlight() const {
  return leaves_.multiply(Stack(3 * layout_.count(), 1.0f));
}

std::vector<ColourBlock> TransportMatrix::rowSums() const {
  std::vector<ColourBlock> sums(leaves_.rows(), ColourBlock::Zero());
  parallelFor(0, leaves_.rows(), 256, [&](std::size_t row) {
    for (std::size_t entry = leaves_.rowBegin(row); entry < leaves_.rowBegin(row + 1); ++entry)
      sums[row] += leaves_.block(row, entry);
  });
  return sums;
}

TransportMatrix rescaledToFloodlight(const TransportMatrix& transport, const Stack& flood, float floor) {
  Stack now = transport.floodlight();
  require(flood.size() == now.size(), "a flood image of {} values for {}", flood.size(), now.size());
  Stack factor(now.size(), 1.0f);
  for (std::size_t i = 0; i < now.size(); ++i)
    if (now[i] > floor && now[i] > 0.0f) factor[i] = std::max(0.0f, flood[i]) / now[i];
  return TransportMatrix(transport.cameras(), transport.projectors(),
                         transport.leaves().withRowsScaled(factor));
}

TransportMatrix thresholded(const TransportMatrix& transport, const ThresholdSettings& settings,
                            const Stack& flood) {
  const BlockSparse& leaves = transport.leaves();
  const NodeLayout& layout = transport.layout();
  std::vector<float> pixelsOf(layout.count());
  for (std::size_t node = 0; node < layout.count(); ++node)
    pixelsOf[node] = static_cast<float>(layout.block(layout.node(node)).count());
  auto strength = [&](std::size_t row, std::size_t entry) {
    return leaves.block(row, entry).cwiseAbs().maxCoeff() / pixelsOf[leaves.column(entry)];
  };
  std::vector<float> limit(leaves.rows());
  parallelFor(0, leaves.rows(), 256, [&](std::size_t row) {
    float strongest = 0.0f;
    for (std::size_t entry = leaves.rowBegin(row); entry < leaves.rowBegin(row + 1); ++entry)
      strongest = std::max(strongest, strength(row, entry));
    // The strongest connection always stays: a camera pixel never leaves the matrix.
    limit[row] = std::min(strongest, std::max(settings.absolute, settings.shareOfRowMax * strongest));
  });
  BlockSparse kept =
      leaves.filtered([&](std::size_t row, std::size_t entry) { return strength(row, entry) >= limit[row]; });
  return rescaledToFloodlight(TransportMatrix(transport.cameras(), transport.projectors(), std::move(kept)),
                              flood);
}

}  // namespace relucent
