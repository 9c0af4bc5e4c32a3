// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "clustering/clustering.h"

namespace relucent {

/// Who belongs together, as far as it is known before T~ and its error: a partition, and what it cost.
struct Grouping {
  std::vector<std::uint32_t> cameraCluster;     // as in Clustering
  std::vector<std::uint32_t> projectorCluster;  // as in Clustering
  std::vector<ClusterSize> sizes;               // as in Clustering
  std::vector<std::uint8_t> kept;               // which connections stay, by place in the graph
  ClusteringStatistics statistics;              // all but errors
};

/// The first half of clustered(), again and again: patches cut, the cap, connected components. What is large
/// is kept from one call to the next, so a slider that moves allocates next to nothing; and where only the
/// cap moved, patches are not cut again. Not to be used by two threads at once.
///  1. Row by row on all cores, patches are cut (lines 1 to 19). What stays joins projector pixels in a
///     forest of disjoint sets without locks, and is offered to its projector pixel as the brightest it has.
///  2. Projector pixels that were cut off get their brightest connection back (line 20).
///  3. Sets are numbered by their lowest projector pixel, or the cap makes smaller ones (size_bound.h).
/// A camera pixel belongs to the cluster of the brightest projector pixel that it sees: patchCut is below
/// one, so that connection always stays.
/// Refers to the graph, which must outlive it.  Storage: about 2 bytes a connection and 40 a pixel.
class Grouper {
 public:
  explicit Grouper(const ConnectionGraph& graph);
  ~Grouper();

  /// Same bits for every number of threads, and whatever was grouped before. Valid until the next call.
  /// Throws: Error{usage} for wrong settings; Cancelled, after which it can be called again.
  const Grouping& group(const ClusteringSettings& settings, Progress& progress);

 private:
  class Work;
  std::unique_ptr<Work> work_;
};

/// How far T~ is from T, without T~ itself.
struct GroupingError {
  std::vector<float> error;  // per camera pixel, as in Clustering
  ClusteringStatistics statistics;
};

/// The second half of clustered() for those who need no T~: the same bits, in less time and memory.
/// `settings`: those of the grouping.  Throws: Cancelled.
GroupingError errorOf(const ConnectionGraph& graph, const Grouping& grouping,
                      const ClusteringSettings& settings, Progress& progress);

}  // namespace relucent
