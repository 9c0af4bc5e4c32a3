// SPDX-License-Identifier: MIT
#include "relucent/clustering/grouping.h"

#include <algorithm>
#include <numeric>

#include "relucent/base/error.h"
#include "relucent/base/parallel.h"
#include "relucent/clustering/approximation.h"
#include "relucent/clustering/patch_cut.h"
#include "relucent/clustering/size_bound.h"

namespace relucent::clustering {
namespace {

/// A quarter of the picture in one cluster is no longer a matter of a few surfaces that light each other;
/// beyond the threshold of percolation the largest cluster soon holds nearly everything, below it a few
/// hundred pixels.
constexpr double percolatedShare = 0.25;
/// Clusters up to this size are inverted quickly however much of a small picture they are.
constexpr std::uint32_t harmlessUnknowns = 256;

Message percolationFinding(const ClusteringStatistics& statistics, const ClusteringSettings& settings) {
  const Argument joined = as::share(
      statistics.largestBeforeCap / static_cast<double>(statistics.litProjectorPixels), as::decimals(0));
  const Argument cut = as::share(settings.patchCut, as::decimals(0));
  if (statistics.capped)
    return RELUCENT_ENGLISH_MESSAGE(
               "clusters.percolated-and-capped",
               "one cluster joins {} % of all lit projector pixels, because neighbouring footprints overlap "
               "by more than a cut of {} % takes away; clusters were held to {} projector pixels, which cut "
               "another {} % of the light")
        .with(joined, cut, settings.mostUnknowns, as::share(statistics.cutByCap, as::decimals(1)));
  return RELUCENT_ENGLISH_MESSAGE("clusters.percolated",
                                  "one cluster joins {} % of all lit projector pixels, because neighbouring "
                                  "footprints overlap by more than a cut of {} % takes away; allow a cap on "
                                  "the size of clusters, or cut more of each patch")
      .with(joined, cut);
}

}  // namespace

class Grouper::Work {
 public:
  explicit Work(const ConnectionGraph& graph)
      : graph_(graph), pixels_(graph.transport().projectors().count()), patches_(graph) {}

  const Grouping& group(const ClusteringSettings& settings, Progress& progress) {
    if (auto found = problems(settings); !found.empty())
      throw Error(ErrorKind::usage, found.front(),
                  RELUCENT_ENGLISH_MESSAGE("clusters.correct-setting", "correct the setting"), "clustering");
    Progress cutting = progress.part(0.5, RELUCENT_MESSAGE("stage.forming-patches", "Forming patches"));
    patches_.cut(settings, cutting);

    Progress joining = progress.part(0.5, RELUCENT_MESSAGE("stage.joining-clusters", "Joining clusters"));
    measureComponents();
    ClusteringStatistics& statistics = result_.statistics;
    statistics.capped =
        settings.cap == SizeCap::always || (settings.cap == SizeCap::whenPercolated && statistics.percolated);
    double cutByCap = 0.0;
    if (statistics.capped) {
      Progress capping =
          joining.part(0.7, RELUCENT_MESSAGE("stage.capping-clusters", "Holding clusters to a size"));
      bound_.join({graph_, patches_.kept(), patches_.brightest()},
                  static_cast<std::uint32_t>(settings.mostUnknowns), capping);
      number(bound_);
      cutByCap = cutBetweenClusters();
    } else {
      number(patches_);
      result_.kept = patches_.kept();
      keptOfRow_ = patches_.keptOfRow();
    }
    countSizes();
    describeLight(cutByCap);
    if (statistics.percolated) statistics.finding = percolationFinding(statistics, settings);
    progress.report(1.0);
    return result_;
  }

 private:
  bool isLit(std::size_t pixel) const { return static_cast<bool>(patches_.brightest()[pixel]); }

  void measureComponents() {
    ClusteringStatistics& s = result_.statistics;
    s = {};
    s.connections = graph_.connections();
    s.reinserted = patches_.reinserted();
    counts_.assign(pixels_, 0);
    for (std::uint32_t pixel = 0; pixel < pixels_; ++pixel)
      if (isLit(pixel)) {
        ++s.litProjectorPixels;
        s.largestBeforeCap = std::max(s.largestBeforeCap, ++counts_[patches_.rootOf(pixel)]);
      }
    s.percolated = s.largestBeforeCap > harmlessUnknowns &&
                   s.largestBeforeCap > percolatedShare * static_cast<double>(s.litProjectorPixels);
  }

  /// Numbers clusters by their roots, which are their lowest projector pixels.
  template <typename Components>
  void number(const Components& components) {
    result_.projectorCluster.assign(pixels_, noCluster);
    result_.cameraCluster.resize(graph_.rows());
    result_.sizes.clear();
    for (std::uint32_t pixel = 0; pixel < pixels_; ++pixel) {
      if (!isLit(pixel)) continue;
      std::uint32_t root = components.rootOf(pixel);
      if (root == pixel) {
        result_.projectorCluster[pixel] = static_cast<std::uint32_t>(result_.sizes.size());
        result_.sizes.emplace_back();
      }
      std::uint32_t cluster = result_.projectorCluster[pixel] = result_.projectorCluster[root];
      ++result_.sizes[cluster].unknowns;
    }
    parallelFor(0, graph_.rows(), 1024, [&](std::size_t i) {
      result_.cameraCluster[i] =
          graph_.row(i).empty() ? noCluster : result_.projectorCluster[components.rootOfRow(i)];
    });
  }

  /// Returns the light of what is cut.
  double cutBetweenClusters() {
    result_.kept = patches_.kept();
    keptOfRow_ = patches_.keptOfRow();
    std::vector<double> light(fixedParts, 0.0);
    parallelChunks(0, graph_.rows(), fixedParts, [&](std::size_t part, std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        std::span<const Connection> row = graph_.row(i);
        std::uint8_t* kept = result_.kept.data() + graph_.placeOf(i);
        forEachKept(kept, row.size(), [&](std::size_t k) {
          if (result_.projectorCluster[row[k].pixel] == result_.cameraCluster[i]) return;
          kept[k] = 0;
          --keptOfRow_[i];
          light[part] += static_cast<double>(row[k].luminance);
        });
      }
    });
    return std::accumulate(light.begin(), light.end(), 0.0);
  }

  void countSizes() {
    ClusteringStatistics& s = result_.statistics;
    for (std::size_t i = 0; i < graph_.rows(); ++i) {
      if (result_.cameraCluster[i] == noCluster) continue;
      ClusterSize& size = result_.sizes[result_.cameraCluster[i]];
      ++size.rows;
      size.connections += keptOfRow_[i];
      s.kept += keptOfRow_[i];
      ++s.litCameraPixels;
    }
    counts_.clear();
    for (const ClusterSize& size : result_.sizes) {
      counts_.push_back(size.unknowns);
      s.largest = std::max(s.largest, size.unknowns);
      s.singledOut += size.rows == 0 ? 1 : 0;
    }
    if (counts_.empty()) return;
    s.meanUnknowns = static_cast<double>(s.litProjectorPixels) / static_cast<double>(counts_.size());
    auto middle = counts_.begin() + static_cast<std::ptrdiff_t>(counts_.size() / 2);
    std::nth_element(counts_.begin(), middle, counts_.end());
    s.medianUnknowns = *middle;
  }

  void describeLight(double cutByCap) {
    ClusteringStatistics& s = result_.statistics;
    s.farLight = 1.0 - graph_.carriedLight();
    double all = graph_.carriedLuminance();
    if (!(all > 0.0)) return;
    // Added up in another order than the whole, what patches left may seem a hair more.
    double left = std::min(patches_.light(), all);
    s.keptLight = graph_.carriedLight() * (left - cutByCap) / all;
    s.cutByPatches = graph_.carriedLight() * (all - left) / all;
    s.cutByCap = graph_.carriedLight() * cutByCap / all;
  }

  const ConnectionGraph& graph_;
  std::size_t pixels_;
  PatchCut patches_;
  SizeBound bound_;
  std::vector<std::uint32_t> keptOfRow_, counts_;
  Grouping result_;
};

Grouper::Grouper(const ConnectionGraph& graph) : work_(std::make_unique<Work>(graph)) {}
Grouper::~Grouper() = default;

const Grouping& Grouper::group(const ClusteringSettings& settings, Progress& progress) {
  return work_->group(settings, progress);
}

GroupingError errorOf(const ConnectionGraph& graph, const Grouping& grouping,
                      const ClusteringSettings& settings, Progress& progress) {
  GroupingError result{errorOfScaled(graph, grouping, settings, progress), grouping.statistics};
  summariseErrors(grouping, result.error, result.statistics);
  return result;
}

}  // namespace relucent::clustering
