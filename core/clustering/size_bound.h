// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <span>

#include "relucent/clustering/brightest.h"
#include "relucent/clustering/disjoint_sets.h"
#include "relucent/clustering/patches.h"

namespace relucent::clustering {

/// What is kept of a graph after patches are cut.
struct CutGraph {
  const ConnectionGraph& graph;
  std::span<const std::uint8_t> kept;    // by index in the graph
  std::span<const Brightest> brightest;  // per projector pixel, of the kept connections
};

/// The largest clusters along the strongest connections that hold at most `most` projector pixels; see
/// clustered() for their order. As Kruskal's algorithm it takes connections in descending order; and like its
/// filtering variant (Osipov, Sanders & Singler 2009), level by level, it ranks only those that can still
/// join something: a connection within a cluster, or between two that are too large together, never can. This
/// does not change the result. Memory is kept between calls.
class SizeBound {
 public:
  /// Throws: Cancelled.
  void join(const CutGraph& cut, std::uint32_t most, Progress& progress);

  /// The lowest projector pixel of a projector pixel's cluster.
  std::uint32_t rootOf(std::uint32_t pixel) const { return root_[pixel]; }
  /// The same of a camera pixel's. Contract: it has connections.
  std::uint32_t rootOfRow(std::size_t row) const { return root_[seen_[row]]; }

 private:
  struct Ranked {
    float strength;
    std::uint32_t row, pixel;
  };
  /// By strength, descending.
  static constexpr std::size_t levels = 16;
  static constexpr std::size_t parts = 64;

  void joinBrightest(const CutGraph& cut);
  void collect(const CutGraph& cut);
  void rank(std::size_t level);
  void joinRanked();
  bool canJoin(std::uint32_t a, std::uint32_t b) const { return a != b && size_[a] + size_[b] <= most_; }

  std::uint32_t most_ = 0;
  DisjointSets sets_;                 // of projector pixels
  std::vector<std::uint32_t> root_;   // of each, in the end
  std::vector<std::uint32_t> size_;   // per root
  std::vector<std::uint32_t> seen_;   // per camera pixel a projector pixel of its cluster
  std::vector<float> rootBrightest_;  // square root of each projector pixel's highest luminance
  std::array<std::array<std::vector<Ranked>, levels>, parts> collected_;
  std::vector<Ranked> ranked_;
};

}  // namespace relucent::clustering
