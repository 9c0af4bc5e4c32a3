// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "relucent/base/enum_names.h"
#include "relucent/base/message.h"
#include "relucent/clustering/connection_graph.h"

namespace relucent::clustering {

/// How line 21 of Algorithm 1 scales the remaining connections.
enum class Rescaling {
  patches,  // first each patch to its own light, in luminance; then the row to the flood image
  rows      // only the row to the flood image
};

inline constexpr EnumName<Rescaling> rescalingNames[]{{Rescaling::patches, "patches"},
                                                      {Rescaling::rows, "rows"}};
constexpr EnumNames<Rescaling> namesOf(Rescaling) {
  return {"rescaling", rescalingNames};
}

/// Limits the size of clusters.
enum class SizeCap { never, whenPercolated, always };
inline constexpr EnumName<SizeCap> sizeCapNames[]{
    {SizeCap::never, "never"}, {SizeCap::whenPercolated, "when_percolated"}, {SizeCap::always, "always"}};
constexpr EnumNames<SizeCap> namesOf(SizeCap) {
  return {"size cap", sizeCapNames};
}

struct ClusteringSettings {
  // Connections dimmer than either limit are left out before Algorithm 1, except the row's brightest.
  float leastLuminance = 0.0f;  // camera signal per second
  double leastShare = 0.0;      // of the row's brightest

  double patchRadius = 8.0;  // thresh1: projector pixels round a patch's brightest; the paper: 5 to 12
  double patchCut = 0.5;  // thresh2: share of a patch's brightest up to which is cut; the paper: 0.3 to 0.7
  Rescaling rescaling = Rescaling::patches;

  SizeCap cap = SizeCap::whenPercolated;
  int mostUnknowns = 256;  // projector pixels of a capped cluster

  bool operator==(const ClusteringSettings&) const = default;
};
std::vector<Message> problems(const ClusteringSettings& settings);

/// Instead of a cluster: a pixel without connections.
constexpr std::uint32_t noCluster = std::numeric_limits<std::uint32_t>::max();

/// Size of a cluster.
struct ClusterSize {
  std::uint32_t unknowns = 0;     // projector pixels
  std::uint32_t rows = 0;         // camera pixels
  std::uint32_t connections = 0;  // kept connections between them
  bool operator==(const ClusterSize&) const = default;
};

struct ClusteringStatistics {
  std::size_t connections = 0;  // before anything is cut
  std::size_t kept = 0;
  std::size_t reinserted = 0;          // projector pixels that had been cut off
  std::size_t litProjectorPixels = 0;  // with any connection
  std::size_t litCameraPixels = 0;
  std::size_t singledOut = 0;  // projector pixels that the cap left without any camera pixel
  std::uint32_t largest = 0;   // unknowns of the largest cluster, and before the cap:
  std::uint32_t largestBeforeCap = 0;
  double meanUnknowns = 0.0;
  std::uint32_t medianUnknowns = 0;
  bool percolated = false;  // as printed, one cluster runs through the whole picture
  bool capped = false;
  // Shares of the light of all usable rows, in luminance, before rows are scaled; they add up to one.
  double keptLight = 0.0;
  double cutByPatches = 0.0;  // thresh2, and the limits before it
  double cutByCap = 0.0;
  double farLight = 0.0;                     // in leaves that carry no connections
  double errorMedian = 0.0, errorP95 = 0.0;  // of the relative RMS error of the lit camera pixels
  Message finding;                           // one sentence about percolation, empty if there is none
};

/// A partition of T's near field into independent clusters. Immutable.
struct Clustering {
  std::vector<std::uint32_t> cameraCluster;     // cluster of every camera pixel, or noCluster
  std::vector<std::uint32_t> projectorCluster;  // cluster of every projector pixel, or noCluster
  std::vector<ClusterSize> sizes;               // clusters by their lowest projector pixel
  transport::TransportMatrix transport;         // the clustered approximation T~: single pixels only
  /// Per camera pixel |T_i - T~_i| / |T_i|, over all of the row's leaves; 0 where T_i = 0.
  std::vector<float> error;
  ClusteringStatistics statistics;
};

/// Algorithm 1 of the paper, line by line, and beyond it a size cap.
///  1-11. Per camera pixel: the brightest unlabelled connected projector pixel is the centre of a patch; all
///     unlabelled connected ones within patchRadius of it join and are labelled; until all are. Pixels of
///     different projectors are never near each other.
///  12-18. Connections of a patch with luminance <= patchCut * the patch's highest are removed.
///  20. A projector pixel left without connections regains the one to the camera pixel that it lights most.
///  21. Remaining connections are scaled. The text wants "the original contribution of the entire patch",
///     the pseudo-code calls this scaling the rows to fit the floodlight: with Rescaling::patches both hold,
///     since patches that have their own light add up to the row's but for far light and colour, which a
///     factor per row and camera channel puts right. Rescaling::rows has that factor alone.
///  Clusters are the connected components of the remaining graph.
/// Percolation occurs where footprints of neighbouring camera pixels overlap: one cluster then joins most of
/// the picture. The cap prevents this: projector pixels are assigned to the camera pixel they light most,
/// then connections join clusters in descending value / sqrt(row's highest * column's highest), while the
/// result has at most mostUnknowns projector pixels; connections between clusters are cut. Ties go to the
/// lower camera pixel, then to the lower projector pixel. Same bits for every number of threads.
/// Source: Wetzstein & Bimber 2007, Algorithm 1; core/clustering/README.md.
/// Throws: Error{usage} for wrong settings; Cancelled.
Clustering clustered(const ConnectionGraph& graph, const ClusteringSettings& settings, Progress& progress);

}  // namespace relucent::clustering
