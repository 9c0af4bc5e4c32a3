// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "relucent/engine/shared_light.h"
#include "relucent/transport/transport_matrix.h"

namespace relucent::engine {

/// The light of a camera pixel from some nodes: T_j = mixing diag(share_j).
struct LightPart {
  transport::ColourBlock mixing = transport::ColourBlock::Zero();
  std::vector<NodeShare> leaves;  // nodes ascending
};

/// A row of T, whose near light has the colours of the surface that the camera pixel sees, and whose far
/// light has other surfaces' too.
struct RowLight {
  LightPart near, far;
  Channels farWeight{};  // what of the row's light one of far.leaves' shares is worth, per projector channel
};

/// Row `row` of T in two parts, each with a mixing of its own. For the blocks T_j of a part
///   mixing = sum_j T_j,      share_jk = <mixing_k, T_jk> / |mixing_k|^2      over the columns k,
/// the least-squares fit that keeps the sum. Near are the nodes of the two finest levels, unless four of them
/// differ by no more than `tolerance` of the row's light from their mean: then the node around them stands
/// for them.
RowLight rowLight(const transport::TransportMatrix& transport, std::size_t row, float tolerance);

}  // namespace relucent::engine
