// SPDX-License-Identifier: MIT
#include "relucent/transport/transport_matrix.h"

#include <algorithm>

#include "relucent/base/error.h"
#include "relucent/base/parallel.h"

namespace relucent::transport {

TransportMatrix::TransportMatrix(Rasters cameras, Rasters projectors, BlockSparse leaves)
    : cameras_(std::move(cameras)), layout_(std::move(projectors)), leaves_(std::move(leaves)) {
  require(leaves_.rows() == cameras_.count() && leaves_.columns() == layout_.count(),
          "{} x {} leaves for {} camera pixels and {} nodes", leaves_.rows(), leaves_.columns(),
          cameras_.count(), layout_.count());
}

CameraStack TransportMatrix::apply(const ProjectorStack& projector) const {
  return CameraStack(leaves_.multiply(layout_.means(projector)));
}

ProjectorStack TransportMatrix::applyTransposed(const CameraStack& camera) const {
  return layout_.meansAdjoint(NodeStack(leaves_.multiplyTransposed(camera)));
}

CameraStack TransportMatrix::floodlight() const {
  return CameraStack(leaves_.multiply(Stack(3 * layout_.count(), 1.0f)));
}

std::vector<ColourBlock> TransportMatrix::rowSums() const {
  std::vector<ColourBlock> sums(leaves_.rows(), ColourBlock::Zero());
  parallelFor(0, leaves_.rows(), 256, [&](std::size_t row) {
    for (std::size_t entry = leaves_.rowBegin(row); entry < leaves_.rowBegin(row + 1); ++entry)
      sums[row] += leaves_.block(row, entry);
  });
  return sums;
}

TransportMatrix rescaledToFloodlight(const TransportMatrix& transport, const CameraStack& flood,
                                     float floor) {
  Stack now = transport.floodlight();
  require(flood.size() == now.size(), "a flood image of {} values for {}", flood.size(), now.size());
  Stack factor(now.size(), 1.0f);
  for (std::size_t i = 0; i < now.size(); ++i)
    if (now[i] > floor && now[i] > 0.0f) factor[i] = std::max(0.0f, flood[i]) / now[i];
  return TransportMatrix(transport.cameras(), transport.projectors(),
                         transport.leaves().withRowsScaled(factor));
}

}  // namespace relucent::transport
