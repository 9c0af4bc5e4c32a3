// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "relucent/transport/transport_matrix.h"

namespace relucent::transport {

/// Pixels of every node, and the node of the next coarser level that holds it (itself at the top): a table
/// for loops over all leaves.
struct NodeTable {
  explicit NodeTable(const NodeLayout& layout);
  std::vector<float> pixels;
  std::vector<std::uint32_t> parent;
};

/// Histogram of the strength of leaves: their number, the connections that they stand for (each pair of a
/// camera pixel and a projector pixel, so that a leaf of 2x2 pixels counts four times) and their light, in
/// logarithmic bins.
struct StrengthHistogram {
  static constexpr int lowestDecade = -9;  // weaker leaves count in the first bin ...
  static constexpr int highestDecade = 3;  // ... stronger ones in the last
  static constexpr int binsPerDecade = 4;
  static constexpr std::size_t bins = (highestDecade - lowestDecade) * binsPerDecade;
  std::array<std::uint64_t, bins> leaves{}, connections{};
  std::array<double, bins> energy{};
};

/// The strength at the lower edge of a bin.
double strengthOfBin(std::size_t bin);
/// The highest edge of a bin below which lies at most 1 - `share` of the light: the cut that a histogram
/// suggests. 0 where there is no light.
double cutKeeping(const StrengthHistogram& histogram, double share);

/// Statistics of T, or of T after a threshold.
struct TransportStatistics {
  std::uint64_t leaves = 0;       // of all camera pixels: one that they share counts for each
  std::uint64_t connections = 0;  // pairs of a camera pixel and a projector pixel
  std::uint64_t bytes = 0;        // in memory
  double energy = 0.0;            // sum of the magnitudes of all values: the light in all leaves
  double energyKept = 1.0;        // share of it that the threshold keeps, before rows are rescaled
  StrengthHistogram histogram;    // of the kept leaves, log10 of strength in camera signal per second
};

/// Statistics of what `thresholded` would keep with these settings, in one pass without a copy. Same bits for
/// every number of threads.  Throws: Error{usage} for wrong settings.
TransportStatistics statisticsOf(const TransportMatrix& transport, const ThresholdSettings& settings = {});

/// Side of the smallest blocks that T has, in projector pixels; 1 once it was measured to the end.
int finestSide(const TransportMatrix& transport);

/// |T_i|^2 of every row over all single projector pixels and nine values, exact for nested leaves, without
/// expanding them: with densities d = value / pixels of the node,
///   |T_i|^2 = sum_k n_k |d_k|^2 + 2 sum_k n_k d_k . (sum of the densities of k's ancestors).
/// `nested` says which rows have leaves inside leaves, if given.
std::vector<double> squaredRowNorms(const TransportMatrix& transport, const NodeTable& nodes,
                                    std::vector<std::uint8_t>* nested = nullptr);

}  // namespace relucent::transport
