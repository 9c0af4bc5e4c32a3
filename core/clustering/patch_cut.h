// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <tuple>

#include "relucent/clustering/brightest.h"
#include "relucent/clustering/disjoint_sets.h"
#include "relucent/clustering/patches.h"

namespace relucent::clustering {

/// Lines 1 to 20 of Algorithm 1, and the connected components of the result. Memory is kept between calls,
/// and a repeated call with the same settings does not cut again.
class PatchCut {
 public:
  explicit PatchCut(const ConnectionGraph& graph);

  /// Throws: Cancelled, after which it can be called again.
  void cut(const ClusteringSettings& settings, Progress& progress);

  const ConnectionGraph& graph() const { return graph_; }
  /// By index in the graph: the connection is kept.
  const std::vector<std::uint8_t>& kept() const { return kept_; }
  /// Number of kept connections per camera pixel.
  const std::vector<std::uint32_t>& keptOfRow() const { return keptOfRow_; }
  /// Per projector pixel, the brightest of the kept connections; none: it has none.
  const std::vector<Brightest>& brightest() const { return brightest_; }
  /// Sum of the luminances of the kept connections.
  double light() const { return light_; }
  /// Projector pixels that had been cut off.
  std::size_t reinserted() const { return reinserted_; }

  /// The lowest projector pixel of a projector pixel's component.
  std::uint32_t rootOf(std::uint32_t pixel) const { return root_[pixel]; }
  /// The same of a camera pixel's. A camera pixel keeps its brightest connection, as patchCut is below one.
  /// Contract: it has connections.
  std::uint32_t rootOfRow(std::size_t row) const { return root_[graph_.row(row).front().pixel]; }

 private:
  void cutRow(std::size_t i, const ClusteringSettings& settings, std::size_t part);
  void offerRow(std::size_t i, const ClusteringSettings& settings);
  void reinsert(const ClusteringSettings& settings);

  const ConnectionGraph& graph_;
  PixelPlaces places_;
  std::vector<PatchFinder> finders_;  // one a part
  std::vector<double> lightOfPart_;

  std::optional<std::tuple<float, double, double, double>> cutFor_;
  std::optional<std::tuple<float, double>> offeredFor_;
  std::vector<Brightest> offered_;  // per projector pixel, of all connections that take part
  std::vector<std::uint8_t> kept_;
  std::vector<std::uint32_t> keptOfRow_;
  std::vector<Brightest> brightest_;
  DisjointSets sets_;  // of projector pixels
  std::vector<std::uint32_t> root_;
  double light_ = 0.0;
  std::size_t reinserted_ = 0;
};

}  // namespace relucent::clustering
