// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include "relucent/transport/transport_matrix.h"

namespace relucent {

/// Every row of T expanded to single projector pixels.  Shape: 3 * camera pixels x 3 * projector pixels.
inline Eigen::MatrixXd expanded(const transport::TransportMatrix& transport) {
  const transport::NodeLayout& layout = transport.layout();
  const Rasters& projectors = layout.projectors();
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(3 * static_cast<Eigen::Index>(transport.cameras().count()),
                                                3 * static_cast<Eigen::Index>(projectors.count()));
  for (std::size_t i = 0; i < transport.cameras().count(); ++i) {
    const transport::LeafRow leaves = transport.row(i);
    for (std::size_t e = 0; e < leaves.size(); ++e) {
      transport::Node node = layout.node(leaves.column(e));
      transport::Block block = layout.block(node);
      auto device = static_cast<std::size_t>(node.projector);
      for (int y = block.y0; y < block.y1; ++y)
        for (int x = block.x0; x < block.x1; ++x) {
          auto j =
              static_cast<Eigen::Index>(projectors.offset(device) + indexOf(projectors.size(device), {x, y}));
          dense.block<3, 3>(3 * static_cast<Eigen::Index>(i), 3 * j) +=
              leaves.block(e).cast<double>() / block.count();
        }
    }
  }
  return dense;
}

}  // namespace relucent
