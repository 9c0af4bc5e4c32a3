// SPDX-License-Identifier: MIT
#include "relucent/engine/patch_sums.h"

#include <algorithm>
#include <cstring>

#include "relucent/base/parallel.h"

namespace relucent::engine {
namespace {

constexpr std::size_t nodesOfARange = 2048;

std::vector<std::uint32_t> patchesOfNodes(const PackedTransport& transport, std::size_t nodes) {
  std::vector<std::uint32_t> count(nodes, 0);
  for (std::uint32_t node : transport.nodes()) ++count[node];
  return count;
}

}  // namespace

PatchSums::PatchSums(const PackedTransport& transport, std::size_t nodes)
    : node_(transport.nodes()), patches_(transport.patches()) {
  const std::vector<std::uint32_t> patchesOfNode = patchesOfNodes(transport, nodes);
  shareOut(transport, patchesOfNode);

  const std::size_t ranges = (nodes + nodesOfARange - 1) / nodesOfARange;
  std::vector<std::vector<Run>> pieces(ranges);
  for (std::uint32_t begin = 0; begin < placeNode_.size();) {
    const std::size_t range = placeNode_[begin] / nodesOfARange;
    std::uint32_t end = begin + 1;
    // Nodes ascend within a patch, and start again with the next one.
    while (end < placeNode_.size() && placeNode_[end] > placeNode_[end - 1] &&
           placeNode_[end] / nodesOfARange == range)
      ++end;
    pieces[range].push_back({begin, end});
    begin = end;
  }
  clearStart_.push_back(0);
  pieceStart_.push_back(0);
  for (std::size_t range = 0; range < ranges; ++range) {
    const auto first = static_cast<std::uint32_t>(range * nodesOfARange);
    const auto last = static_cast<std::uint32_t>(std::min(nodes, (range + 1) * nodesOfARange));
    for (std::uint32_t node = first; node < last; ++node) {
      if (patchesOfNode[node] == 1) continue;
      if (clear_.size() > clearStart_.back() && clear_.back().end == node)
        ++clear_.back().end;
      else
        clear_.push_back({node, node + 1});
    }
    clearStart_.push_back(static_cast<std::uint32_t>(clear_.size()));
    piece_.insert(piece_.end(), pieces[range].begin(), pieces[range].end());
    pieceStart_.push_back(static_cast<std::uint32_t>(piece_.size()));
  }
}

void PatchSums::shareOut(const PackedTransport& transport, const std::vector<std::uint32_t>& patchesOfNode) {
  columnsStart_.push_back(0);
  for (const TransportPatch& patch : transport.patches()) {
    for (std::uint32_t begin = patch.columnBegin; begin < patch.columnEnd;) {
      const bool alone = patchesOfNode[node_[begin]] == 1;
      std::uint32_t end = begin;
      while (end < patch.columnEnd && (patchesOfNode[node_[end]] == 1) == alone) ++end;
      columns_.push_back({begin, end, alone ? none : static_cast<std::uint32_t>(placeNode_.size())});
      if (!alone) placeNode_.insert(placeNode_.end(), node_.begin() + begin, node_.begin() + end);
      begin = end;
    }
    columnsStart_.push_back(static_cast<std::uint32_t>(columns_.size()));
  }
}

void PatchSums::addPatch(std::size_t patch, const float* columns, std::size_t stride, float* sums,
                         float* waiting) const noexcept {
  const std::uint32_t first = patches_[patch].columnBegin;
  for (std::uint32_t i = columnsStart_[patch]; i < columnsStart_[patch + 1]; ++i) {
    const Columns& run = columns_[i];
    const float* from = columns + stride * (run.begin - first);
    if (run.place == none) {
      for (std::uint32_t column = run.begin; column < run.end; ++column, from += stride)
        std::memcpy(sums + sumFloats * std::size_t{node_[column]}, from, sumFloats * sizeof(float));
    } else {
      float* to = waiting + sumFloats * run.place;
      for (std::uint32_t column = run.begin; column < run.end; ++column, from += stride, to += sumFloats)
        std::memcpy(to, from, sumFloats * sizeof(float));
    }
  }
}

void PatchSums::addStored(const float* waiting, float* sums) const noexcept {
  parallelFor(0, clearStart_.size() - 1, 4, [&](std::size_t range) {
    for (std::uint32_t i = clearStart_[range]; i < clearStart_[range + 1]; ++i)
      std::fill(sums + sumFloats * std::size_t{clear_[i].begin},
                sums + sumFloats * std::size_t{clear_[i].end}, 0.0f);
    for (std::uint32_t i = pieceStart_[range]; i < pieceStart_[range + 1]; ++i) {
      for (std::uint32_t place = piece_[i].begin; place < piece_[i].end; ++place) {
        float* out = sums + sumFloats * std::size_t{placeNode_[place]};
        for (std::size_t c = 0; c < sumFloats; ++c) out[c] += waiting[sumFloats * place + c];
      }
    }
  });
}

}  // namespace relucent::engine
