// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include "image/image.h"

namespace relucent {

/// What pictures are like before anything is known of them: a random field on a raster of pixels whose
/// covariance falls exponentially with distance,
///   C(dx, dy) = exp(-(|dx| + |dy|) / reach) = L L^T,
/// where L is a first-order recursion along x and then along y: four passes instead of a dense matrix.
/// Source: core/inverse/README.md, [Jain].
class SmoothPrior {
 public:
  /// `reach` in pixels, above 0.
  explicit SmoothPrior(double reach);

  /// t <- t L. Shapes: any rows x raster.count(), pixels row by row.
  void timesRoot(Eigen::MatrixXf& t, Size raster) const;
  /// t <- t L^T. Shapes as above; with timesRoot() before, t C.
  void timesRootTransposed(Eigen::MatrixXf& t, Size raster) const;
  /// Standard deviation of the field's mean over side x side pixels.
  float spreadOfMean(int side) const;

 private:
  float kept_;   // of a pixel's value that its neighbour shares
  float fresh_;  // of it that is the neighbour's own: kept^2 + fresh^2 = 1
};

}  // namespace relucent
