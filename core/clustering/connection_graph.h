// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/progress.h"
#include "transport/statistics.h"

namespace relucent {

/// A camera pixel sees a projector pixel: one edge of the bipartite graph that clusters are parts of.
struct Connection {
  std::uint32_t pixel = 0;  // projector pixel, over all projectors
  std::uint32_t leaf = 0;   // the entry of T that carries it
  float luminance = 0.0f;   // of what the camera pixel sees of the projector pixel in white
};

struct ConnectionGraphSettings {
  double leastShare = 0.01;  // of the row's brightest projector pixel: dimmer leaves carry no connection
  int coarsestLevel = 3;     // wider leaves carry none: their light is even over more than a patch
};
std::vector<std::string> problems(const ConnectionGraphSettings& settings);

/// The near field of T pixel by pixel, every row from its brightest connection down: prepared once, after
/// which clustering with other thresholds is quick. A leaf of several pixels is a connection to each of them
/// with its mean; where leaves are nested, the brightest carries a pixel's connection. Rows that are not
/// usable, and values that are negative or no numbers, have no connections.
/// Refers to T, which must outlive it.  Storage: 12 bytes a connection.
class ConnectionGraph {
 public:
  /// `usable`: per camera pixel, 0 where it must not be relied on.
  /// Throws: Error{usage} for wrong settings; Cancelled.
  ConnectionGraph(const TransportMatrix& transport, const std::vector<std::uint8_t>& usable,
                  const ConnectionGraphSettings& settings, Progress& progress);

  const TransportMatrix& transport() const { return *transport_; }
  const NodeTable& nodes() const { return nodes_; }
  std::size_t rows() const { return length_.size(); }
  std::size_t connections() const { return connections_; }
  std::size_t bytes() const;

  /// Brightest first, equals by the lower projector pixel.
  std::span<const Connection> row(std::size_t row) const { return {&edges_[start_[row]], length_[row]}; }
  /// Where a row begins in arrays with a place for every connection; places() long.
  std::size_t placeOf(std::size_t row) const { return start_[row]; }
  std::size_t places() const { return start_.back(); }

  /// T 1, to which rows are scaled.
  const Stack& flood() const { return flood_; }
  /// |T_i|^2 over all leaves, those without connections too.
  double squaredNorm(std::size_t row) const { return squaredNorm_[row]; }
  /// Whether the row has leaves inside leaves.
  bool nested(std::size_t row) const { return nested_[row] != 0; }
  /// Share of the light of all usable rows, in luminance, that the connections carry.
  double carriedLight() const { return carriedLight_; }
  /// The same light itself: the sum of the connections' luminances.
  double carriedLuminance() const { return carriedLuminance_; }
  /// Leaves of coarser levels carry no connections; below the setting if there were too many otherwise.
  int coarsestLevel() const { return coarsestLevel_; }

 private:
  const TransportMatrix* transport_;
  NodeTable nodes_;
  std::vector<std::size_t> start_;
  std::vector<std::uint32_t> length_;
  std::vector<Connection> edges_;
  Stack flood_;
  std::vector<double> squaredNorm_;
  std::vector<std::uint8_t> nested_;
  std::size_t connections_ = 0;
  double carriedLight_ = 0.0;
  double carriedLuminance_ = 0.0;
  int coarsestLevel_ = 0;
};

}  // namespace relucent
