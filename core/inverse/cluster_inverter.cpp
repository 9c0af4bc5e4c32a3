// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "relucent/base/error.h"
#include "relucent/base/parallel.h"
#include "relucent/inverse/cluster_inverse.h"
#include "relucent/inverse/cluster_solver.h"
#include "relucent/inverse/unmixing.h"

namespace relucent::inverse {
namespace {

/// Factoring more equations than this takes minutes, inverting more weights gigabytes: not what clusters
/// are for.
constexpr std::size_t mostEquations = 4096;
constexpr std::size_t mostWeights = std::size_t{1} << 28;

constexpr std::size_t clustersBetweenReports = 1024;

/// Members of every group in ascending order, as ranges of one array.
void sortIntoGroups(const std::vector<std::uint32_t>& groupOf, const std::vector<std::uint8_t>* among,
                    std::size_t groups, std::vector<std::size_t>& start, std::vector<std::uint32_t>& member) {
  start.assign(groups + 1, 0);
  auto takes = [&](std::size_t i) { return groupOf[i] != clustering::noCluster && (!among || (*among)[i]); };
  for (std::size_t i = 0; i < groupOf.size(); ++i)
    if (takes(i)) ++start[groupOf[i] + 1];
  for (std::size_t group = 0; group < groups; ++group) start[group + 1] += start[group];
  member.resize(start.back());
  std::vector<std::size_t> next(start.begin(), start.end() - 1);
  for (std::size_t i = 0; i < groupOf.size(); ++i)
    if (takes(i)) member[next[groupOf[i]]++] = static_cast<std::uint32_t>(i);
}

}  // namespace

/// Fills a ClusterInverse.
class ClusterInverter {
 public:
  ClusterInverter(const clustering::Clustering& clustering, const CameraMask& usable,
                  const ClusterInverseSettings& settings)
      : transport_(clustering.transport), settings_(settings) {
    inverse_.cameras_ = clustering.transport.cameras();
    inverse_.projectors_ = clustering.transport.projectors();
    inverse_.full_ = settings.colour == ClusterColour::full;
    std::size_t clusters = clustering.sizes.size();
    sortIntoGroups(clustering.cameraCluster, &usable, clusters, inverse_.rowStart_, inverse_.row_);
    sortIntoGroups(clustering.projectorCluster, nullptr, clusters, inverse_.pixelStart_, inverse_.pixel_);
    inverse_.scale_.assign(clusters, 0.0f);
    placeInCluster_.resize(inverse_.projectors_.count());
    inverse_.weightStart_.assign(clusters + 1, 0);
    for (std::size_t cluster = 0; cluster < clusters; ++cluster) {
      std::size_t rows = inverse_.rowStart_[cluster + 1] - inverse_.rowStart_[cluster];
      std::size_t pixels = inverse_.pixelStart_[cluster + 1] - inverse_.pixelStart_[cluster];
      for (std::size_t j = 0; j < pixels; ++j)
        placeInCluster_[inverse_.pixel_[inverse_.pixelStart_[cluster] + j]] = static_cast<std::uint32_t>(j);
      requireInvertible(rows, pixels);
      inverse_.weightStart_[cluster + 1] = inverse_.weightStart_[cluster] + rows * pixels * inverse_.planes();
    }
    inverse_.weight_.resize(inverse_.weightStart_.back());
    unmix(clustering.transport, usable);
  }

  ClusterInverse invertAll(Progress& progress) {
    double lambda = settings_.ridge * meanDiagonal();
    std::size_t clusters = inverse_.scale_.size();
    for (std::size_t first = 0; first < clusters; first += clustersBetweenReports) {
      std::size_t last = std::min(first + clustersBetweenReports, clusters);
      parallelFor(first, last, 1, [&](std::size_t cluster) { invert(cluster, lambda); });
      progress.report(static_cast<double>(last) / static_cast<double>(clusters));
    }
    progress.report(1.0);
    return std::move(inverse_);
  }

 private:
  std::size_t channels() const { return inverse_.full_ ? 3 : 1; }

  void requireInvertible(std::size_t rows, std::size_t pixels) const {
    if (std::min(rows, pixels) * channels() <= mostEquations &&
        rows * pixels * inverse_.planes() <= mostWeights)
      return;
    throw Error(ErrorKind::memory,
                RELUCENT_ENGLISH_MESSAGE(
                    "inverse.cluster-too-large",
                    "a cluster joins {} projector pixels and {} camera pixels, too many to invert")
                    .with(pixels, rows),
                RELUCENT_ENGLISH_MESSAGE("inverse.cap-clusters-or-cut-more",
                                         "hold clusters to a size, or cut more of each patch"));
  }

  /// Takes each camera pixel to the common scale.
  void unmix(const transport::TransportMatrix& transport, const CameraMask& usable) {
    std::vector<transport::ColourBlock> mixing = transport.rowSums();
    inverse_.unmix_.assign(9 * mixing.size(), 0.0f);
    parallelFor(0, mixing.size(), 256, [&](std::size_t row) {
      if (!usable[row]) return;
      Eigen::Map<transport::ColourBlock> u(&inverse_.unmix_[9 * row]);
      float brightness = mixing[row].sum() / 3.0f;
      if (!inverse_.full_)
        u = regularisedUnmixing(mixing[row]);
      else if (brightness > 0.0f)
        u = transport::ColourBlock::Identity() / brightness;
      if (!u.allFinite()) u.setZero();
    });
  }

  /// A connection of A: its 3x3 block on the common scale, or in its one value the mean of the channels.
  transport::ColourBlock connection(std::size_t row, const transport::LeafRow& leaves,
                                    std::size_t entry) const {
    return Eigen::Map<const transport::ColourBlock>(&inverse_.unmix_[9 * row]) * leaves.block(entry);
  }

  /// Mean diagonal of A^T A over all unknowns of all clusters.
  double meanDiagonal() const {
    std::vector<double> sums(fixedParts, 0.0);
    parallelChunks(
        0, inverse_.row_.size(), fixedParts, [&](std::size_t part, std::size_t begin, std::size_t end) {
          for (std::size_t k = begin; k < end; ++k) {
            std::size_t row = inverse_.row_[k];
            const transport::LeafRow leaves = transport_.row(row);
            for (std::size_t entry = 0; entry < leaves.size(); ++entry) {
              transport::ColourBlock value = connection(row, leaves, entry);
              float mean = value.trace() / 3.0f;
              sums[part] += static_cast<double>(inverse_.full_ ? value.squaredNorm() : mean * mean);
            }
          }
        });
    double sum = 0.0;
    for (double part : sums) sum += part;
    return inverse_.pixel_.empty() ? 0.0 : sum / static_cast<double>(inverse_.pixel_.size() * channels());
  }

  /// A of one cluster; in full colour, row 3 i + c and column 3 j + p.
  Eigen::MatrixXf blockOf(std::size_t cluster) const {
    auto side = static_cast<Eigen::Index>(channels());
    std::size_t firstRow = inverse_.rowStart_[cluster], lastRow = inverse_.rowStart_[cluster + 1];
    auto rows = static_cast<Eigen::Index>(lastRow - firstRow);
    auto pixels =
        static_cast<Eigen::Index>(inverse_.pixelStart_[cluster + 1] - inverse_.pixelStart_[cluster]);
    Eigen::MatrixXf block = Eigen::MatrixXf::Zero(side * rows, side * pixels);
    for (Eigen::Index i = 0; i < rows; ++i) {
      std::size_t row = inverse_.row_[firstRow + static_cast<std::size_t>(i)];
      const transport::LeafRow leaves = transport_.row(row);
      for (std::size_t entry = 0; entry < leaves.size(); ++entry) {
        auto j = static_cast<Eigen::Index>(placeInCluster_[leaves.column(entry)]);
        transport::ColourBlock value = connection(row, leaves, entry);
        if (inverse_.full_)
          block.block<3, 3>(3 * i, 3 * j) = value;
        else
          block(i, j) = value.trace() / 3.0f;
      }
    }
    return block;
  }

  void invert(std::size_t cluster, double lambda) {
    Eigen::MatrixXf weights = clusterPseudoInverse(blockOf(cluster), lambda, settings_);
    if (weights.size() == 0) return;
    float scale = weights.cwiseAbs().maxCoeff() / 32767.0f;
    inverse_.scale_[cluster] = scale;
    if (!(scale > 0.0f)) return;
    auto side = static_cast<Eigen::Index>(channels());
    Eigen::Index pixels = weights.rows() / side, rows = weights.cols() / side;
    std::int16_t* code = inverse_.weight_.data() + inverse_.weightStart_[cluster];
    for (Eigen::Index i = 0; i < rows; ++i)
      for (Eigen::Index p = 0; p < side; ++p)
        for (Eigen::Index c = 0; c < side; ++c)
          for (Eigen::Index j = 0; j < pixels; ++j)
            *code++ = static_cast<std::int16_t>(std::lround(weights(side * j + p, side * i + c) / scale));
  }

  const transport::TransportMatrix& transport_;
  const ClusterInverseSettings& settings_;
  std::vector<std::uint32_t> placeInCluster_;
  ClusterInverse inverse_;
};

ClusterInverse computeClusterInverse(const clustering::Clustering& clustering, const CameraMask& usable,
                                     const ClusterInverseSettings& settings, Progress& progress) {
  if (auto found = problems(settings); !found.empty())
    throw Error(ErrorKind::usage, found.front(),
                RELUCENT_ENGLISH_MESSAGE("clusters.correct-setting", "correct the setting"),
                "cluster inverse");
  require(usable.size() == clustering.cameraCluster.size(), "{} usable flags for {} camera pixels",
          usable.size(), clustering.cameraCluster.size());
  progress.checkpoint();
  return ClusterInverter(clustering, usable, settings).invertAll(progress);
}

}  // namespace relucent::inverse
