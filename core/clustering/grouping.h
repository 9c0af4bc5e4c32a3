// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "relucent/clustering/clustering.h"

namespace relucent::clustering {

/// The partition into clusters with its statistics, without T~ and its error.
struct Grouping {
  std::vector<std::uint32_t> cameraCluster;     // as in Clustering
  std::vector<std::uint32_t> projectorCluster;  // as in Clustering
  std::vector<ClusterSize> sizes;               // as in Clustering
  std::vector<std::uint8_t> kept;               // which connections are kept, by index in the graph
  ClusteringStatistics statistics;              // all but errors
};

/// The first half of clustered(), for repeated use: cutting patches, the cap, connected components. Large
/// arrays are kept between calls, so a moving slider allocates hardly anything; and if only the cap changes,
/// patches are not cut again. Not thread-safe.
///  1. Row by row on all cores, patches are cut (lines 1 to 19). The kept ones join projector pixels in a
///     forest of disjoint sets without locks, and is offered to its projector pixel as the brightest it has.
///  2. Projector pixels that were cut off regain their brightest connection (line 20).
///  3. Sets are numbered by their lowest projector pixel, or the cap makes smaller ones (size_bound.h).
/// A camera pixel belongs to the cluster of the brightest projector pixel that it sees: patchCut is below
/// one, so that connection is always kept.
/// Refers to the graph, which must outlive it.  Storage: about 2 bytes a connection and 40 a pixel.
class Grouper {
 public:
  explicit Grouper(const ConnectionGraph& graph);
  ~Grouper();

  /// Same bits for every number of threads and whatever earlier calls were. Valid until the next call.
  /// Throws: Error{usage} for wrong settings; Cancelled, after which it can be called again.
  const Grouping& group(const ClusteringSettings& settings, Progress& progress);

 private:
  class Work;
  std::unique_ptr<Work> work_;
};

/// The error of T~, without T~ itself.
struct GroupingError {
  std::vector<float> error;  // per camera pixel, as in Clustering
  ClusteringStatistics statistics;
};

/// The second half of clustered() for callers that do not need T~: the same bits, in less time and memory.
/// `settings`: those of the grouping.  Throws: Cancelled.
GroupingError errorOf(const ConnectionGraph& graph, const Grouping& grouping,
                      const ClusteringSettings& settings, Progress& progress);

}  // namespace relucent::clustering
