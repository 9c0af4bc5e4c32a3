// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "relucent/base/progress.h"
#include "relucent/transport/statistics.h"

namespace relucent::clustering {

/// One edge of the bipartite graph of camera and projector pixels: the camera pixel sees the projector pixel.
struct Connection {
  std::uint32_t pixel = 0;  // projector pixel, over all projectors
  std::uint32_t leaf = 0;   // the place in the row of T of what carries it
  float luminance = 0.0f;   // of the camera pixel's signal from the projector pixel at white
};

struct ConnectionGraphSettings {
  double leastShare = 0.01;  // of the row's brightest projector pixel: dimmer leaves become no connection
  int coarsestLevel = 3;     // wider leaves become none: their light is uniform over more than a patch
};
std::vector<Message> problems(const ConnectionGraphSettings& settings);

/// The near field of T pixel by pixel, every row from its brightest connection down: prepared once, after
/// which clustering with other thresholds is fast. A leaf of several pixels is a connection to each of them
/// with its mean; where leaves are nested, the brightest determines a pixel's connection. Unusable rows, and
/// values that are negative or NaN, have no connections.
/// Refers to T, which must outlive it.  Storage: 12 bytes a connection.
class ConnectionGraph {
 public:
  /// `usable`: per camera pixel, 0 where it must not be relied on.
  /// Throws: Error{usage} for wrong settings; Cancelled.
  ConnectionGraph(const transport::TransportMatrix& transport, const CameraMask& usable,
                  const ConnectionGraphSettings& settings, Progress& progress);

  const transport::TransportMatrix& transport() const { return *transport_; }
  const transport::NodeTable& nodes() const { return nodes_; }
  std::size_t rows() const { return length_.size(); }
  std::size_t connections() const { return connections_; }
  std::size_t bytes() const;

  /// Brightest first, ties by the lower projector pixel.
  std::span<const Connection> row(std::size_t row) const { return {&edges_[start_[row]], length_[row]}; }
  /// Index of a row's first connection in arrays of places() elements, one per connection.
  std::size_t placeOf(std::size_t row) const { return start_[row]; }
  std::size_t places() const { return start_.back(); }

  /// T 1, to which rows are scaled.
  const CameraStack& flood() const { return flood_; }
  /// |T_i|^2 over all leaves, those without connections too.
  double squaredNorm(std::size_t row) const { return squaredNorm_[row]; }
  /// Whether the row has leaves inside leaves.
  bool nested(std::size_t row) const { return nested_[row] != 0; }
  /// Share of the light of all usable rows, in luminance, of all connections.
  double carriedLight() const { return carriedLight_; }
  /// That light itself: the sum of the connections' luminances.
  double carriedLuminance() const { return carriedLuminance_; }
  /// Leaves of coarser levels become no connections; lower than the setting if there would be too many
  /// otherwise.
  int coarsestLevel() const { return coarsestLevel_; }

 private:
  const transport::TransportMatrix* transport_;
  transport::NodeTable nodes_;
  std::vector<std::size_t> start_;
  std::vector<std::uint32_t> length_;
  std::vector<Connection> edges_;
  CameraStack flood_;
  std::vector<double> squaredNorm_;
  std::vector<std::uint8_t> nested_;
  std::size_t connections_ = 0;
  double carriedLight_ = 0.0;
  double carriedLuminance_ = 0.0;
  int coarsestLevel_ = 0;
};

}  // namespace relucent::clustering
