// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "relucent/engine/packed_transport.h"

namespace relucent::engine {

/// Rows of leaves in slices of 32 for a graphics card: first the first leaves of all rows of a slice, then
/// all second ones, and so on. Rows of a patch are sorted by length, so that little padding is needed;
/// padding has codes 0. ("SELL-C-sigma": Kreutzer et al. 2014.)
struct LeafSlices {
  static constexpr std::uint32_t lanes = 32;
  /// Start of a slice's leaves, in units of 32; and the base of their positions.
  struct Slice {
    std::uint32_t leaf = 0, base = 0;
  };
  std::vector<Slice> slices;  // plus one past the last
  std::vector<PackedLeaf> leaves;

  std::size_t count() const { return slices.empty() ? 0 : slices.size() - 1; }
};

/// PackedTransport for graphics cards: the same 8 bytes a leaf, once by camera pixels for T p and once by
/// nodes for the adjoint, which therefore needs no atomic additions: sums have a fixed order.
/// What goes back from a patch stands in one list: for each row what its leaves and what its group gets, and
/// for each group what its leaves get. Leaves of `backward` refer to these places.
struct SlicedTransport {
  static constexpr std::uint32_t none = 0xffffffffu;
  /// A camera pixel's position in its slice. `pixel` is none in padding.
  struct Row {
    std::uint32_t pixel = none;
    std::array<float, 9> own{}, shared{};
    std::uint32_t group = none;  // its position in its slice
    std::uint32_t back = 0;      // for its leaves; for its group behind it
  };
  /// A group's position in its slice. `back` is none in padding.
  struct Group {
    std::uint32_t parent = none, back = none;
    std::uint32_t rowBegin = 0, rowEnd = 0;  // of groupBack
    float scale = 0.0f;
  };

  LeafSlices forward;       // places: columns of the patch
  std::vector<Row> rows;    // 32 a slice of `forward`
  LeafSlices groupForward;  // the same of groups
  std::vector<Group> groups;
  std::vector<std::uint32_t> groupBack;  // where rows, in the order of PackedTransport, tell their group
  std::size_t backPlaces = 0;
  LeafSlices backward;
  std::vector<std::uint32_t> nodeStart, segments;  // of node n: [nodeStart[n], nodeStart[n + 1]) of segments,
                                                   // 32 to a slice of `backward`
  std::vector<std::uint32_t> longNodes;            // with `longNode` segments or more

  static constexpr std::uint32_t longestSegment = 64;  // leaves
  static constexpr std::uint32_t longNode = 64;        // segments
};

SlicedTransport slicedTransport(const PackedTransport& packed, std::size_t nodes);

}  // namespace relucent::engine
