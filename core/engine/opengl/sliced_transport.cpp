// SPDX-License-Identifier: MIT
#include "relucent/engine/opengl/sliced_transport.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace relucent::engine {
namespace {

constexpr std::uint32_t lanes = LeafSlices::lanes;

/// Some leaves that belong to one row or one segment.
struct Run {
  std::uint32_t owner = 0;  // row or column
  std::vector<PackedLeaf> leaves;
};

/// Appends a patch's runs as slices, the longest first.
void append(LeafSlices& to, std::uint32_t base, std::vector<Run>& runs) {
  std::stable_sort(runs.begin(), runs.end(),
                   [](const Run& a, const Run& b) { return a.leaves.size() > b.leaves.size(); });
  for (std::size_t first = 0; first < runs.size(); first += lanes) {
    const std::size_t longest = runs[first].leaves.size();
    to.slices.push_back({static_cast<std::uint32_t>(to.leaves.size() / lanes), base});
    for (std::size_t k = 0; k < longest; ++k) {
      for (std::size_t lane = first; lane < first + lanes; ++lane) {
        const bool filled = lane < runs.size() && k < runs[lane].leaves.size();
        to.leaves.push_back(filled ? runs[lane].leaves[k] : PackedLeaf{});
      }
    }
  }
}

/// Leaves that get the same share of what goes back: a row's or a group's.
struct Receiver {
  std::uint32_t place = 0;  // in its patch's list
  std::vector<PackedLeaf> leaves;
};

/// A patch's leaves by columns, cut into pieces that are not too long; every column that has any has one at
/// least. Their column is the place of what goes back to them.
std::vector<Run> segmentsOf(std::size_t columns, const std::vector<Receiver>& receivers) {
  std::vector<Run> ofColumn(columns), segments;
  for (const Receiver& receiver : receivers)
    for (const PackedLeaf& leaf : receiver.leaves)
      ofColumn[leaf.column].leaves.push_back({leaf.code, static_cast<std::uint16_t>(receiver.place)});
  for (std::uint32_t column = 0; column < columns; ++column) {
    const std::vector<PackedLeaf>& all = ofColumn[column].leaves;
    for (std::size_t begin = 0; begin < all.size(); begin += SlicedTransport::longestSegment) {
      const std::size_t end = std::min<std::size_t>(begin + SlicedTransport::longestSegment, all.size());
      segments.push_back({column,
                          {all.begin() + static_cast<std::ptrdiff_t>(begin),
                           all.begin() + static_cast<std::ptrdiff_t>(end)}});
    }
  }
  return segments;
}

/// Cuts the patches into slices, one after the other.
class Slicer {
 public:
  Slicer(const PackedTransport& packed, std::size_t nodes)
      : packed_(packed), nodes_(static_cast<std::uint32_t>(nodes)) {
    result_.groupBack.resize(packed.rows().size());
  }

  void add(const TransportPatch& patch) {
    const auto firstBack = static_cast<std::uint32_t>(result_.backPlaces);
    std::vector<Receiver> receivers;
    const std::vector<std::uint32_t> slotOfGroup = addGroups(patch, firstBack, receivers);
    addRows(patch, firstBack, slotOfGroup, receivers);
    std::vector<Run> segments = segmentsOf(patch.columnEnd - patch.columnBegin, receivers);
    append(result_.backward, firstBack, segments);
    for (const Run& segment : segments)
      nodeOfSegment_.push_back(packed_.nodes()[patch.columnBegin + segment.owner]);
    nodeOfSegment_.resize(lanes * result_.backward.slices.size(), nodes_);
  }

  SlicedTransport finish() {
    for (LeafSlices* slices : {&result_.forward, &result_.groupForward, &result_.backward})
      slices->slices.push_back({static_cast<std::uint32_t>(slices->leaves.size() / lanes), 0});
    result_.nodeStart.assign(nodes_ + 1, 0);
    for (std::uint32_t node : nodeOfSegment_)
      if (node != nodes_) ++result_.nodeStart[node + 1];
    std::partial_sum(result_.nodeStart.begin(), result_.nodeStart.end(), result_.nodeStart.begin());
    result_.segments.resize(result_.nodeStart.back());
    std::vector<std::uint32_t> next(result_.nodeStart.begin(), result_.nodeStart.end() - 1);
    for (std::uint32_t segment = 0; segment < nodeOfSegment_.size(); ++segment)
      if (nodeOfSegment_[segment] != nodes_) result_.segments[next[nodeOfSegment_[segment]]++] = segment;
    for (std::uint32_t node = 0; node < nodes_; ++node)
      if (result_.nodeStart[node + 1] - result_.nodeStart[node] >= SlicedTransport::longNode)
        result_.longNodes.push_back(node);
    return std::move(result_);
  }

 private:
  /// Without what fills it up.
  static Run runOf(const TransportPatch& patch, std::uint32_t owner, std::vector<PackedLeaf> leaves) {
    while (!leaves.empty() && leaves.back().column >= patch.columnEnd - patch.columnBegin) leaves.pop_back();
    return {owner, std::move(leaves)};
  }

  /// Returns the groups' slots.
  std::vector<std::uint32_t> addGroups(const TransportPatch& patch, std::uint32_t firstBack,
                                       std::vector<Receiver>& receivers) {
    std::vector<Run> runs;
    for (std::uint32_t i = patch.groupBegin; i < patch.groupEnd; ++i)
      runs.push_back(runOf(patch, i, packed_.leavesOf(packed_.groups()[i])));
    const auto first = static_cast<std::uint32_t>(result_.groups.size());
    append(result_.groupForward, patch.columnBegin, runs);
    std::vector<std::uint32_t> slot(runs.size());
    for (std::uint32_t i = 0; i < runs.size(); ++i) slot[runs[i].owner - patch.groupBegin] = first + i;
    for (const Run& run : runs) {
      const PackedGroup& of = packed_.groups()[run.owner];
      const auto place = static_cast<std::uint32_t>(result_.backPlaces++);
      receivers.push_back({place - firstBack, run.leaves});
      result_.groups.push_back(
          {of.parent == PackedGroup::none ? SlicedTransport::none : slot[of.parent - patch.groupBegin], place,
           of.rowBegin, of.rowEnd, of.scale});
    }
    result_.groups.resize(lanes * result_.groupForward.slices.size());
    return slot;
  }

  void addRows(const TransportPatch& patch, std::uint32_t firstBack,
               const std::vector<std::uint32_t>& slotOfGroup, std::vector<Receiver>& receivers) {
    std::vector<Run> runs;
    for (std::uint32_t i = patch.rowBegin; i < patch.rowEnd; ++i)
      runs.push_back(runOf(patch, i, packed_.leavesOf(packed_.rows()[i])));
    append(result_.forward, patch.columnBegin, runs);
    for (const Run& run : runs) {
      const PackedRow& row = packed_.rows()[run.owner];
      const auto back = static_cast<std::uint32_t>(result_.backPlaces);
      result_.backPlaces += 2;
      receivers.push_back({back - firstBack, run.leaves});
      result_.groupBack[run.owner] = back + 1;
      const std::uint32_t slot =
          row.group == PackedGroup::none ? SlicedTransport::none : slotOfGroup[row.group - patch.groupBegin];
      SlicedTransport::Row slotted{row.pixel, {}, {}, slot, back};
      Eigen::Map<transport::ColourBlock>(slotted.own.data()) = packed_.ownMixing(row);
      Eigen::Map<transport::ColourBlock>(slotted.shared.data()) = packed_.sharedMixing(row);
      result_.rows.push_back(slotted);
    }
    result_.rows.resize(lanes * result_.forward.slices.size());
  }

  const PackedTransport& packed_;
  std::uint32_t nodes_;
  SlicedTransport result_;
  std::vector<std::uint32_t> nodeOfSegment_;  // nodes_ where there is none
};

}  // namespace

SlicedTransport slicedTransport(const PackedTransport& packed, std::size_t nodes) {
  Slicer slicer(packed, nodes);
  for (const TransportPatch& patch : packed.patches()) slicer.add(patch);
  return slicer.finish();
}

}  // namespace relucent::engine
