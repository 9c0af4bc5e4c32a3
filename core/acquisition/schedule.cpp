// SPDX-License-Identifier: MIT
#include "relucent/acquisition/schedule.h"

#include <algorithm>
#include <bit>
#include <numeric>

#include "relucent/base/parallel.h"

namespace relucent::acquisition {
namespace {

constexpr int improvementRounds = 12;

/// The camera pixels of every node: the pairs the other way round.
struct Footprints {
  Footprints(const transport::BlockSparse& pairs, std::size_t firstNode, std::size_t nodes)
      : start(nodes + 1, 0) {
    for (std::size_t entry = 0; entry < pairs.blocks(); ++entry) ++start[pairs.column(entry) - firstNode + 1];
    std::partial_sum(start.begin(), start.end(), start.begin());
    row.resize(pairs.blocks());
    std::vector<std::size_t> next(start.begin(), start.end() - 1);
    for (std::size_t r = 0; r < pairs.rows(); ++r)
      for (std::size_t entry = pairs.rowBegin(r); entry < pairs.rowBegin(r + 1); ++entry)
        row[next[pairs.column(entry) - firstNode]++] = static_cast<std::uint32_t>(r);
  }
  std::size_t size(std::size_t node) const { return start[node + 1] - start[node]; }

  std::vector<std::size_t> start;
  std::vector<std::uint32_t> row;
};

/// Which colours each camera pixel has seen, 64 to a plane.
class SeenColours {
 public:
  explicit SeenColours(std::size_t rows) : rows_(rows) {}

  std::uint32_t smallestFree(const Footprints& footprints, std::size_t node) {
    for (std::size_t plane = 0;; ++plane) {
      if (plane == planes_.size()) planes_.emplace_back(rows_, 0);
      std::uint64_t seen = 0;
      for (std::size_t i = footprints.start[node]; i < footprints.start[node + 1] && ~seen != 0; ++i)
        seen |= planes_[plane][footprints.row[i]];
      if (~seen != 0)
        return static_cast<std::uint32_t>(64 * plane) + static_cast<std::uint32_t>(std::countr_one(seen));
    }
  }
  void mark(const Footprints& footprints, std::size_t node, std::uint32_t colour) {
    std::vector<std::uint64_t>& plane = planes_[colour / 64];
    for (std::size_t i = footprints.start[node]; i < footprints.start[node + 1]; ++i)
      plane[footprints.row[i]] |= std::uint64_t{1} << (colour % 64);
  }

 private:
  std::size_t rows_;
  std::vector<std::vector<std::uint64_t>> planes_;
};

Schedule colouredInOrder(const std::vector<std::uint32_t>& order, const Footprints& footprints,
                         std::size_t rows) {
  Schedule result;
  result.colourOf.assign(footprints.start.size() - 1, Schedule::dark);
  SeenColours seen(rows);
  for (std::uint32_t node : order) {
    std::uint32_t colour = seen.smallestFree(footprints, node);
    seen.mark(footprints, node, colour);
    result.colourOf[node] = colour;
    result.colours = std::max(result.colours, colour + 1);
  }
  return result;
}

/// How many other nodes each node conflicts with.
std::vector<std::size_t> degrees(const transport::BlockSparse& pairs, std::size_t firstNode,
                                 const Footprints& footprints) {
  std::size_t nodes = footprints.start.size() - 1;
  std::vector<std::size_t> degree(nodes, 0);
  parallelChunks(0, nodes, 64, [&](std::size_t, std::size_t begin, std::size_t end) {
    std::vector<std::uint32_t> counted(nodes, Schedule::dark);
    for (std::size_t node = begin; node < end; ++node) {
      for (std::size_t i = footprints.start[node]; i < footprints.start[node + 1]; ++i) {
        std::size_t row = footprints.row[i];
        for (std::size_t entry = pairs.rowBegin(row); entry < pairs.rowBegin(row + 1); ++entry) {
          std::uint32_t& mark = counted[pairs.column(entry) - firstNode];
          if (mark == node) continue;
          mark = static_cast<std::uint32_t>(node);
          ++degree[node];
        }
      }
    }
  });
  return degree;
}

template <typename Key>
std::vector<std::uint32_t> descending(std::vector<std::uint32_t> nodes, const Key& key) {
  std::stable_sort(nodes.begin(), nodes.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return key(a) > key(b); });
  return nodes;
}

}  // namespace

Schedule schedule(const transport::BlockSparse& pairs, std::size_t firstNode, std::size_t nodes) {
  Footprints footprints(pairs, firstNode, nodes);
  std::vector<std::uint32_t> lit;
  for (std::uint32_t node = 0; node < nodes; ++node)
    if (footprints.size(node) > 0) lit.push_back(node);

  std::vector<std::size_t> degree = degrees(pairs, firstNode, footprints);
  auto bySize = [&](std::uint32_t node) { return footprints.size(node); };
  auto byDegree = [&](std::uint32_t node) { return degree[node]; };
  Schedule best = colouredInOrder(descending(lit, bySize), footprints, pairs.rows());
  Schedule other = colouredInOrder(descending(lit, byDegree), footprints, pairs.rows());
  if (other.colours < best.colours) best = std::move(other);

  for (int round = 0; round < improvementRounds; ++round) {
    auto lastClassFirst = [&](std::uint32_t node) { return best.colourOf[node]; };
    best = colouredInOrder(descending(lit, lastClassFirst), footprints, pairs.rows());
  }
  best.firstNode = firstNode;
  return best;
}

}  // namespace relucent::acquisition
