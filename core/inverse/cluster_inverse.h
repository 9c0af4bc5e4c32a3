// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "relucent/base/progress.h"
#include "relucent/clustering/clustering.h"

namespace relucent::inverse {

enum class ClusterSolver {
  ridge,        // A^+ = (A^T A + lambda I)^-1 A^T, by Cholesky on the smaller side
  truncatedSvd  // A^+ = V S^+ U^T without the small singular values, as in the paper
};

enum class ClusterColour {
  shared,  // colours unmixed per camera pixel, then one scalar inverse for all three channels
  full     // every connection is its 3x3 block, paper eq. 2: 27 times the work, 9 times the memory
};

struct ClusterInverseSettings {
  ClusterSolver solver = ClusterSolver::ridge;
  ClusterColour colour = ClusterColour::shared;
  double ridge = 0.25;       // lambda as a share of the mean diagonal of A^T A over all clusters
  double truncation = 0.05;  // singular values up to this share of the cluster's largest are left out
  bool whiteFlood = true;    // scale so that the flood image gives white
};
std::vector<Message> problems(const ClusterInverseSettings& settings);

/// The paper's operator: every cluster inverted on its own, recombined into one sparse T+.
///   p_cluster = A^+ U r_cluster
/// U brings each camera pixel to a common scale: its unmixing (shared) or the inverse of its brightness
/// (full), so that dark surfaces count as much as bright ones. Storage: 16-bit fixed point with one scale per
/// cluster, 2 (shared) or 18 (full) bytes for each pair of projector and camera pixel in a cluster.
/// Immutable; made by computeClusterInverse().  Source: core/inverse/README.md; Wetzstein & Bimber 2007,
/// section 4.
class ClusterInverse {
 public:
  ClusterInverse() = default;

  const Rasters& cameras() const { return cameras_; }
  const Rasters& projectors() const { return projectors_; }
  std::size_t bytes() const;

  /// p = T+ r, not clamped. Same bits for every number of threads.
  /// Shapes: 3 * cameras().count() -> 3 * projectors().count().
  /// Units: camera signal per second -> linear drive. Projector pixels in no cluster stay 0.
  ProjectorStack apply(const CameraStack& cameraResidual) const;

  /// The whole operator for other programs, U included: rows = projector pixels, columns = camera pixels.
  transport::BlockSparse matrix() const;

  bool operator==(const ClusterInverse&) const = default;

 private:
  friend class ClusterInverter;
  std::size_t planes() const { return full_ ? 9 : 1; }

  Rasters cameras_;
  Rasters projectors_;
  bool full_ = false;
  std::vector<float> unmix_;  // 3x3 a camera pixel, row-major
  // Members of cluster k: [start[k], start[k + 1]), ascending; its weights likewise.
  std::vector<std::size_t> rowStart_, pixelStart_, weightStart_;
  std::vector<std::uint32_t> row_, pixel_;
  LargeVector<std::int16_t> weight_;  // [cluster][row][plane: 3 * projector channel + camera channel][pixel]
  std::vector<float> scale_;          // per cluster: weight = scale * code
};

/// Inverts every cluster of T~. A dim projector pixel's row of A^+ is scaled to white by dividing it by its
/// value for the flood image; where its weights almost cancel there, so that dividing would amplify them, the
/// pixel gets the weighted mean of the camera pixels that see it instead. `usable`: per camera pixel, 0 where
/// it is unreliable. Throws: Error{usage} for wrong settings; Error{memory} if a cluster is too large to be
/// inverted; Error{numerics} if one cannot be factored; Cancelled.
ClusterInverse computeClusterInverse(const clustering::Clustering& clustering, const CameraMask& usable,
                                     const ClusterInverseSettings& settings, Progress& progress);

}  // namespace relucent::inverse
