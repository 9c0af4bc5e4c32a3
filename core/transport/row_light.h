// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "relucent/transport/shared_light.h"
#include "relucent/transport/transport_matrix.h"

namespace relucent::transport {

/// The light of a camera pixel from some nodes: T_j = mixing diag(share_j).
struct LightPart {
  ColourBlock mixing = ColourBlock::Zero();
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
RowLight rowLight(const TransportMatrix& transport, std::size_t row, float tolerance);
/// The same for each projector alone; `tolerance` is of the whole row's light.
std::vector<RowLight> rowLights(const TransportMatrix& transport, std::size_t row, float tolerance);
/// The same for a T of one projector that has groups, as it divides near and far light itself: pixels of a
/// group have the group's shares to the bit.
RowLight rowLightAsShared(const TransportMatrix& transport, std::size_t row);

}  // namespace relucent::transport
