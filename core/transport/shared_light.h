// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "relucent/transport/node_layout.h"

namespace relucent::transport {

/// A value for each projector channel.
using Channels = std::array<float, 3>;

/// The share that a node's light has in the far light of a camera pixel, for each projector channel.
struct NodeShare {
  std::uint32_t node = 0;  // of the NodeLayout
  Channels share{};
};

Channels sumOf(const std::vector<NodeShare>& shares);

/// Leaves that all camera pixels of a square block see alike, beside those of the wider block around it.
struct LightGroup {
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
  std::uint32_t parent = none;     // the next wider block that has leaves
  std::size_t begin = 0, end = 0;  // its places
  std::vector<NodeShare> leaves;
};

/// The far light of a square of camera pixels, on both sides of a tree: pixel i sees the leaves j of its own,
/// of groupOf[i] and of all its parents,
///   sum over j:  share_j * light of node j.
struct SharedLight {
  static constexpr int side = 8;
  static constexpr std::size_t pixels = side * side;
  std::vector<LightGroup> groups;  // parents first
  std::array<std::vector<NodeShare>, pixels> own;
  std::array<std::uint32_t, pixels> groupOf{};

  /// The place of a camera pixel within the square: Z order, so that every block is a range of places.
  static std::size_t placeOf(int x, int y);
};

/// Divides the light of 8x8 camera pixels among blocks of 8, 4, 2 and 1 of them and of projector nodes, in as
/// few leaves as the tolerance permits. A leaf (block C, node n) of share m holds where
///   weight_ic |t_ic(n') - m_c |n'| / |n|| <= tolerance      for all pixels i of C and all n' within n,
/// with t_i(n') the light that i sees of n' and m the mean over C, weighted by weight squared. Which of the
/// leaves that hold are taken, is the least number: by dynamic programming over pairs of blocks and nodes,
///   cost(C, n) = 1 where the leaf holds, else the least of  sum over n's children,  sum over C's quarters.
/// `pixels`: the leaves of each place, none where there is no camera pixel. `weight`: by how much errors
/// count; what has weight 0 is taken to be as its neighbours.
/// Source: block cluster trees of hierarchical matrices, Hackbusch 1999; core/engine/README.md.
SharedLight shareLight(const NodeLayout& layout, std::span<const std::vector<NodeShare>> pixels,
                       std::span<const Channels> weight, float tolerance);

}  // namespace relucent::transport
