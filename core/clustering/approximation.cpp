// SPDX-License-Identifier: MIT
#include "relucent/clustering/approximation.h"

#include <algorithm>
#include <cmath>

#include "relucent/base/parallel.h"
#include "relucent/base/signed_codes.h"
#include "relucent/clustering/patches.h"
#include "relucent/image/colour.h"

namespace relucent::clustering {
namespace {

constexpr std::size_t chunks = 64;
/// A channel that kept less than this share of the row's brightest is noise: scaling it to the flood image
/// on its own could blow it up without bound, so it goes along with the others.
constexpr float leastChannelShare = 1e-3f;

/// One row of T~ as it is made.
class RowScaler {
 public:
  RowScaler(const ConnectionGraph& graph, const PixelPlaces& places, const Grouping& grouping,
            const ClusteringSettings& settings)
      : graph_(graph), kept_(grouping.kept), settings_(settings), finder_(places) {}

  struct Entry {
    std::uint32_t pixel;
    transport::ColourBlock original;  // density of the leaf that carries the connection
    transport::ColourBlock scaled;
  };

  /// Kept connections by ascending projector pixel. Valid until the next call.
  const std::vector<Entry>& scaled(std::size_t i) {
    entries_.clear();
    std::span<const Connection> row = bright(graph_.row(i), settings_);
    const std::uint8_t* kept = kept_.data() + graph_.placeOf(i);
    if (std::none_of(kept, kept + row.size(), [](std::uint8_t k) { return k != 0; })) return entries_;

    const std::vector<double>& gain = patchGains(row, kept);
    const transport::LeafRow leaves = graph_.transport().row(i);
    Eigen::Vector3f sum = Eigen::Vector3f::Zero();
    for (std::size_t k = 0; k < row.size(); ++k) {
      if (!kept[k]) continue;
      std::uint32_t leaf = row[k].leaf;
      transport::ColourBlock density = leaves.block(leaf) / graph_.nodes().pixels[leaves.column(leaf)];
      transport::ColourBlock gained = density * static_cast<float>(gain[k]);
      sum += gained.rowwise().sum();
      entries_.push_back({row[k].pixel, density, gained});
    }
    Eigen::Vector3f factor = floodFactors(i, sum);
    for (Entry& entry : entries_) entry.scaled = factor.asDiagonal() * entry.scaled;
    std::sort(entries_.begin(), entries_.end(),
              [](const Entry& a, const Entry& b) { return a.pixel < b.pixel; });
    return entries_;
  }

 private:
  /// Per connection, what gives its patch the light that it had before anything was cut.
  const std::vector<double>& patchGains(std::span<const Connection> row, const std::uint8_t* kept) {
    gain_.assign(row.size(), 1.0);
    if (settings_.rescaling == Rescaling::rows) return gain_;
    const std::vector<std::uint32_t>& patch = finder_.patchesOf(row, settings_.patchRadius);
    whole_.assign(finder_.patches(), 0.0);
    left_.assign(finder_.patches(), 0.0);
    for (std::size_t k = 0; k < row.size(); ++k) {
      whole_[patch[k]] += static_cast<double>(row[k].luminance);
      if (kept[k]) left_[patch[k]] += static_cast<double>(row[k].luminance);
    }
    for (std::size_t k = 0; k < row.size(); ++k)
      if (left_[patch[k]] > 0.0) gain_[k] = whole_[patch[k]] / left_[patch[k]];
    return gain_;
  }

  Eigen::Vector3f floodFactors(std::size_t i, const Eigen::Vector3f& sum) const {
    Eigen::Vector3f flood(graph_.flood()[3 * i], graph_.flood()[3 * i + 1], graph_.flood()[3 * i + 2]);
    float seen = image::luminanceOf(flood[0], flood[1], flood[2]),
          left = image::luminanceOf(sum[0], sum[1], sum[2]);
    Eigen::Vector3f factor = Eigen::Vector3f::Constant(left > 0.0f ? std::max(0.0f, seen) / left : 1.0f);
    for (int c = 0; c < 3; ++c)
      if (sum[c] > leastChannelShare * sum.maxCoeff()) factor[c] = std::max(0.0f, flood[c]) / sum[c];
    return factor;
  }

  const ConnectionGraph& graph_;
  const std::vector<std::uint8_t>& kept_;
  const ClusteringSettings& settings_;
  PatchFinder finder_;
  std::vector<double> gain_, whole_, left_;
  std::vector<Entry> entries_;
};

/// What T holds for one projector pixel: the sum of all leaves over it, where leaves are nested.
transport::ColourBlock allLightOf(const ConnectionGraph& graph, std::size_t row, std::uint32_t pixel) {
  const transport::LeafRow leaves = graph.transport().row(row);
  const transport::NodeTable& nodes = graph.nodes();
  transport::ColourBlock sum = transport::ColourBlock::Zero();
  std::size_t entry = 0;
  for (std::uint32_t node = pixel;; node = nodes.parent[node]) {
    while (entry < leaves.size() && leaves.column(entry) < node) ++entry;
    if (entry < leaves.size() && leaves.column(entry) == node)
      sum += leaves.block(entry) / nodes.pixels[node];
    if (nodes.parent[node] == node) return sum;
  }
}

float relativeError(const ConnectionGraph& graph, std::size_t row,
                    const std::vector<RowScaler::Entry>& entries) {
  double whole = graph.squaredNorm(row);
  if (!std::isfinite(whole)) return 1.0f;
  if (!(whole > 0.0)) return 0.0f;
  double apart = whole;
  for (const RowScaler::Entry& entry : entries) {
    transport::ColourBlock light = graph.nested(row) ? allLightOf(graph, row, entry.pixel) : entry.original;
    Eigen::Matrix3d scaled = entry.scaled.cast<double>(), original = light.cast<double>();
    apart += scaled.squaredNorm() - 2.0 * scaled.cwiseProduct(original).sum();
  }
  // Rounding can leave a tiny negative square where nothing was cut.
  return static_cast<float>(std::sqrt(std::max(0.0, apart) / whole));
}

/// Calls visit(row, entries) for all rows, on all cores.
template <typename Visit>
void visitScaledRows(const ConnectionGraph& graph, const Grouping& grouping,
                     const ClusteringSettings& settings, const Progress& progress, const Visit& visit) {
  PixelPlaces places(graph.transport().projectors());
  parallelChunks(0, graph.rows(), chunks, [&](std::size_t, std::size_t begin, std::size_t end) {
    progress.checkpoint();
    RowScaler scaler(graph, places, grouping, settings);
    for (std::size_t i = begin; i < end; ++i) visit(i, scaler.scaled(i));
  });
}

}  // namespace

Approximation scaledToFloodlight(const ConnectionGraph& graph, const Grouping& grouping,
                                 const ClusteringSettings& settings, Progress& progress) {
  std::size_t rows = graph.rows();
  std::vector<std::size_t> start(rows + 1, 0);
  parallelFor(0, rows, 256, [&](std::size_t i) {
    const std::uint8_t* kept = grouping.kept.data() + graph.placeOf(i);
    start[i + 1] = static_cast<std::size_t>(
        std::count_if(kept, kept + graph.row(i).size(), [](std::uint8_t k) { return k != 0; }));
  });
  for (std::size_t i = 0; i < rows; ++i) start[i + 1] += start[i];
  progress.report(0.1);

  Approximation result{{}, std::vector<float>(rows, 0.0f)};
  LargeVector<std::uint32_t> column(start.back());
  LargeVector<transport::BlockSparseWriter::Code> code(start.back());
  std::vector<float> scale(rows, 0.0f);
  visitScaledRows(graph, grouping, settings, progress,
                  [&](std::size_t i, const std::vector<RowScaler::Entry>& entries) {
                    for (const RowScaler::Entry& entry : entries)
                      scale[i] = std::max(scale[i], entry.scaled.cwiseAbs().maxCoeff() / largestCode);
                    std::size_t next = start[i];
                    for (const RowScaler::Entry& entry : entries) {
                      column[next] = entry.pixel;
                      code[next++] = transport::codeOf(entry.scaled, scale[i]);
                    }
                    result.error[i] = relativeError(graph, i, entries);
                  });
  progress.report(0.9);
  const transport::TransportMatrix& transport = graph.transport();
  result.transport = transport::TransportMatrix(
      transport.cameras(), transport.projectors(),
      transport::BlockSparse::assembled(transport.layout().count(), std::move(start), std::move(column),
                                        std::move(code), std::move(scale)));
  progress.report(1.0);
  return result;
}

std::vector<float> errorOfScaled(const ConnectionGraph& graph, const Grouping& grouping,
                                 const ClusteringSettings& settings, Progress& progress) {
  std::vector<float> error(graph.rows(), 0.0f);
  visitScaledRows(graph, grouping, settings, progress,
                  [&](std::size_t i, const std::vector<RowScaler::Entry>& entries) {
                    error[i] = relativeError(graph, i, entries);
                  });
  progress.report(1.0);
  return error;
}

void summariseErrors(const Grouping& grouping, const std::vector<float>& error,
                     ClusteringStatistics& statistics) {
  std::vector<float> lit;
  for (std::size_t i = 0; i < error.size(); ++i)
    if (grouping.cameraCluster[i] != noCluster) lit.push_back(error[i]);
  if (lit.empty()) return;
  auto ranked = [&lit](std::size_t rank) {
    auto place = lit.begin() + static_cast<std::ptrdiff_t>(rank);
    std::nth_element(lit.begin(), place, lit.end());
    return static_cast<double>(*place);
  };
  statistics.errorMedian = ranked(lit.size() / 2);
  statistics.errorP95 = ranked(lit.size() * 95 / 100);
}

}  // namespace relucent::clustering
