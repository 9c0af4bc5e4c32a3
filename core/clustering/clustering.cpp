// SPDX-License-Identifier: MIT
#include "clustering/clustering.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/parallel.h"
#include "clustering/approximation.h"
#include "clustering/components.h"

namespace relucent {
namespace {

/// A quarter of the picture in one cluster is no longer a matter of a few surfaces that light each other;
/// beyond the threshold of percolation the largest cluster soon holds nearly everything, below it a few
/// hundred pixels.
constexpr double percolatedShare = 0.25;
/// Clusters up to this size are inverted quickly however much of a small picture they are.
constexpr std::uint32_t harmlessUnknowns = 256;

constexpr std::size_t parts = 64;

std::uint32_t largestOf(const std::vector<ClusterSize>& sizes) {
  std::uint32_t largest = 0;
  for (const ClusterSize& size : sizes) largest = std::max(largest, size.unknowns);
  return largest;
}

/// Luminance of all kept connections, added up as the graph adds up all of them.
double lightOf(const ConnectionGraph& graph, const KeptConnections& connections) {
  std::vector<double> sums(parts, 0.0);
  parallelChunks(0, graph.rows(), parts, [&](std::size_t part, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      std::span<const Connection> row = graph.row(i);
      const std::uint8_t* kept = connections.kept.data() + graph.placeOf(i);
      for (std::size_t k = 0; k < row.size(); ++k)
        if (kept[k]) sums[part] += static_cast<double>(row[k].luminance);
    }
  });
  double sum = 0.0;
  for (double part : sums) sum += part;
  return sum;
}

void countSizes(const Clustering& clustering, ClusteringStatistics& statistics) {
  std::vector<std::uint32_t> unknowns;
  for (const ClusterSize& size : clustering.sizes) {
    unknowns.push_back(size.unknowns);
    statistics.litProjectorPixels += size.unknowns;
    statistics.litCameraPixels += size.rows;
    statistics.singledOut += size.rows == 0 ? 1 : 0;
  }
  statistics.largest = largestOf(clustering.sizes);
  if (unknowns.empty()) return;
  statistics.meanUnknowns =
      static_cast<double>(statistics.litProjectorPixels) / static_cast<double>(unknowns.size());
  auto middle = unknowns.begin() + static_cast<std::ptrdiff_t>(unknowns.size() / 2);
  std::nth_element(unknowns.begin(), middle, unknowns.end());
  statistics.medianUnknowns = *middle;
}

void summariseErrors(const Clustering& clustering, ClusteringStatistics& statistics) {
  std::vector<float> errors;
  for (std::size_t i = 0; i < clustering.error.size(); ++i)
    if (clustering.cameraCluster[i] != noCluster) errors.push_back(clustering.error[i]);
  if (errors.empty()) return;
  std::sort(errors.begin(), errors.end());
  statistics.errorMedian = static_cast<double>(errors[errors.size() / 2]);
  statistics.errorP95 = static_cast<double>(errors[errors.size() * 95 / 100]);
}

std::string percolationFinding(const ClusteringStatistics& statistics, std::size_t lit,
                               const ClusteringSettings& settings) {
  double share = 100.0 * statistics.largestBeforeCap / static_cast<double>(lit);
  std::string said = fmt::format(
      "one cluster joins {:.0f} % of all lit projector pixels, because neighbouring footprints overlap by "
      "more "
      "than a cut of {:.0f} % takes away",
      share, 100.0 * settings.patchCut);
  if (statistics.capped)
    return said + fmt::format(
                      "; clusters were held to {} projector pixels, which cut another {:.1f} % of the "
                      "light",
                      settings.mostUnknowns, 100.0 * statistics.cutByCap);
  return said + "; allow a cap on the size of clusters, or cut more of each patch";
}

}  // namespace

std::vector<std::string> problems(const ClusteringSettings& settings) {
  std::vector<std::string> found;
  if (!(settings.leastLuminance >= 0.0f)) found.push_back("the least luminance must not be negative");
  if (!(settings.leastShare >= 0.0 && settings.leastShare <= 1.0))
    found.push_back("the share of a row's brightest connection must lie between 0 and 1");
  if (!(settings.patchRadius >= 0.0 && settings.patchRadius <= 10000.0))
    found.push_back("the radius of a patch must lie between 0 and 10000 projector pixels");
  if (!(settings.patchCut >= 0.0 && settings.patchCut < 1.0))
    found.push_back("the cut of a patch must be at least 0 and below 1");
  if (settings.mostUnknowns < 1 || settings.mostUnknowns > 4096)
    found.push_back("a capped cluster must have 1 to 4096 projector pixels");
  return found;
}

Clustering clustered(const ConnectionGraph& graph, const ClusteringSettings& settings, Progress& progress) {
  if (auto found = problems(settings); !found.empty())
    throw Error(ErrorKind::usage, found.front(), "correct the setting", "clustering");

  Progress cutting = progress.part(0.3, "Forming patches");
  PixelPlaces places(graph.transport().projectors());
  KeptConnections connections = cutPatches(graph, places, settings, cutting);
  double cut = lightOf(graph, connections);

  Progress joining = progress.part(0.4, "Joining clusters");
  Partition partition = connectedComponents(graph, connections);
  joining.report(0.3);
  ClusteringStatistics statistics;
  std::size_t lit = 0;
  for (std::uint8_t pixel : connections.lit) lit += pixel;
  statistics.connections = graph.connections();
  statistics.reinserted = connections.reinserted;
  statistics.largestBeforeCap = largestOf(partition.sizes);
  statistics.percolated = statistics.largestBeforeCap > harmlessUnknowns &&
                          statistics.largestBeforeCap > percolatedShare * static_cast<double>(lit);
  statistics.capped =
      settings.cap == SizeCap::always || (settings.cap == SizeCap::whenPercolated && statistics.percolated);
  if (statistics.capped) {
    Progress capping = joining.part(0.7, "Holding clusters to a size");
    partition = cappedComponents(graph, settings, connections, capping);
  }

  Progress scaling = progress.part(0.3, "Scaling to the flood image");
  Approximation approximation = scaledToFloodlight(graph, places, connections, settings, scaling);
  Clustering result{std::move(partition.camera),    std::move(partition.projector),
                    std::move(partition.sizes),     std::move(approximation.transport),
                    std::move(approximation.error), {}};
  const BlockSparse& kept = result.transport.leaves();
  statistics.kept = kept.blocks();
  for (std::size_t row = 0; row < kept.rows(); ++row)
    if (result.cameraCluster[row] != noCluster)
      result.sizes[result.cameraCluster[row]].connections +=
          static_cast<std::uint32_t>(kept.rowBegin(row + 1) - kept.rowBegin(row));

  statistics.farLight = 1.0 - graph.carriedLight();
  if (double all = graph.carriedLuminance(); all > 0.0) {
    double left = statistics.capped ? lightOf(graph, connections) : cut;
    statistics.keptLight = graph.carriedLight() * left / all;
    statistics.cutByPatches = graph.carriedLight() * (all - cut) / all;
    statistics.cutByCap = graph.carriedLight() * (cut - left) / all;
  }
  countSizes(result, statistics);
  summariseErrors(result, statistics);
  if (statistics.percolated) statistics.finding = percolationFinding(statistics, lit, settings);
  result.statistics = std::move(statistics);
  progress.report(1.0);
  return result;
}

}  // namespace relucent
