// SPDX-License-Identifier: MIT
#include "relucent/engine/opengl/sliced_transport.h"

#include <algorithm>
#include <numeric>

namespace relucent::engine {
namespace {

constexpr std::uint32_t lanes = LeafSlices::lanes;

/// Some leaves that belong to one row or one segment.
struct Run {
  std::uint32_t owner = 0;  // row or column
  std::uint32_t begin = 0, end = 0;
  std::uint32_t length() const { return end - begin; }
};

/// Appends a patch's runs as slices, the longest first. `leafAt`: a run's leaf by its number.
template <typename LeafAt>
void append(LeafSlices& to, std::uint32_t base, std::vector<Run>& runs, const LeafAt& leafAt) {
  std::stable_sort(runs.begin(), runs.end(),
                   [](const Run& a, const Run& b) { return a.length() > b.length(); });
  for (std::size_t first = 0; first < runs.size(); first += lanes) {
    const std::uint32_t longest = runs[first].length();
    to.slices.push_back({static_cast<std::uint32_t>(to.leaves.size() / lanes), base});
    for (std::uint32_t k = 0; k < longest; ++k) {
      for (std::size_t lane = first; lane < first + lanes; ++lane) {
        const bool filled = lane < runs.size() && k < runs[lane].length();
        to.leaves.push_back(filled ? leafAt(runs[lane].begin + k) : PackedLeaf{});
      }
    }
  }
}

/// A patch's leaves by columns.
struct ByColumn {
  std::vector<std::uint32_t> start;  // of a column's leaves
  std::vector<PackedLeaf> leaves;    // their column is the row's place in the patch

  ByColumn(const PackedTransport& packed, const TransportPatch& patch,
           const std::vector<std::uint32_t>& slotOfRow)
      : start(patch.columnEnd - patch.columnBegin + 1, 0) {
    const std::uint32_t begin = packed.leafStart()[patch.rowBegin], end = packed.leafStart()[patch.rowEnd];
    for (std::uint32_t i = begin; i < end; ++i) ++start[packed.leaves()[i].column + 1u];
    std::partial_sum(start.begin(), start.end(), start.begin());
    leaves.resize(end - begin);
    std::vector<std::uint32_t> next(start.begin(), start.end() - 1);
    for (std::uint32_t row = patch.rowBegin; row < patch.rowEnd; ++row) {
      for (std::uint32_t i = packed.leafStart()[row]; i < packed.leafStart()[row + 1]; ++i) {
        PackedLeaf leaf = packed.leaves()[i];
        std::uint32_t& to = next[leaf.column];
        leaf.column = static_cast<std::uint16_t>(slotOfRow[row - patch.rowBegin]);
        leaves[to++] = leaf;
      }
    }
  }

  /// Its columns, cut into pieces that are not too long; every column has one at least.
  std::vector<Run> segments() const {
    std::vector<Run> runs;
    for (std::uint32_t column = 0; column + 1 < start.size(); ++column)
      for (std::uint32_t begin = start[column]; begin < start[column + 1];
           begin += SlicedTransport::longestSegment)
        runs.push_back({column, begin, std::min(begin + SlicedTransport::longestSegment, start[column + 1])});
    return runs;
  }
};

}  // namespace

SlicedTransport slicedTransport(const PackedTransport& packed, std::size_t nodes) {
  SlicedTransport result;
  std::vector<std::uint32_t> nodeOfSegment;  // nodes where there is none
  const auto none = static_cast<std::uint32_t>(nodes);
  for (const TransportPatch& patch : packed.patches()) {
    std::vector<Run> rows;
    for (std::uint32_t row = patch.rowBegin; row < patch.rowEnd; ++row)
      rows.push_back({row, packed.leafStart()[row], packed.leafStart()[row + 1]});
    const auto firstSlot = static_cast<std::uint32_t>(result.rows.size());
    append(result.forward, patch.columnBegin, rows, [&](std::uint32_t i) { return packed.leaves()[i]; });

    std::vector<std::uint32_t> slotOfRow(rows.size());
    for (std::uint32_t slot = 0; slot < rows.size(); ++slot) {
      slotOfRow[rows[slot].owner - patch.rowBegin] = slot;
      SlicedTransport::Row row{packed.pixels()[rows[slot].owner], {}};
      std::copy_n(&packed.mixing()[9 * std::size_t{rows[slot].owner}], 9, row.mixing.begin());
      result.rows.push_back(row);
    }
    result.rows.resize(lanes * result.forward.slices.size());

    const ByColumn columns(packed, patch, slotOfRow);
    std::vector<Run> segments = columns.segments();
    append(result.backward, firstSlot, segments, [&](std::uint32_t i) { return columns.leaves[i]; });
    for (const Run& segment : segments)
      nodeOfSegment.push_back(packed.nodes()[patch.columnBegin + segment.owner]);
    nodeOfSegment.resize(lanes * result.backward.slices.size(), none);
  }
  for (LeafSlices* slices : {&result.forward, &result.backward})
    slices->slices.push_back({static_cast<std::uint32_t>(slices->leaves.size() / lanes), 0});

  result.nodeStart.assign(nodes + 1, 0);
  for (std::uint32_t node : nodeOfSegment)
    if (node != none) ++result.nodeStart[node + 1];
  std::partial_sum(result.nodeStart.begin(), result.nodeStart.end(), result.nodeStart.begin());
  result.segments.resize(result.nodeStart.back());
  std::vector<std::uint32_t> next(result.nodeStart.begin(), result.nodeStart.end() - 1);
  for (std::uint32_t segment = 0; segment < nodeOfSegment.size(); ++segment)
    if (nodeOfSegment[segment] != none) result.segments[next[nodeOfSegment[segment]]++] = segment;
  for (std::uint32_t node = 0; node < nodes; ++node)
    if (result.nodeStart[node + 1] - result.nodeStart[node] >= SlicedTransport::longNode)
      result.longNodes.push_back(node);
  return result;
}

}  // namespace relucent::engine
