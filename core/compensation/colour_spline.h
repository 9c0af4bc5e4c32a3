// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <span>

namespace relucent::compensation {

/// A smooth map of colours through scattered samples: the thin-plate spline in three dimensions,
///   f(x) = a_0 + A x - sum_m w_m |x - x_m|,   sum_m w_m = 0,   sum_m w_m x_m^T = 0,
///   f(x_m) + smoothing w_m = d_m.
/// Samples of a linear map give that map.
/// Source: Wahba, Spline Models for Observational Data, 1990.
class ColourSpline {
 public:
  /// Contract: as many `from` as `to`, at least four that lie in no plane. `smoothing` at least 0.
  ColourSpline(std::span<const Eigen::Vector3d> from, std::span<const Eigen::Vector3d> to, double smoothing);

  Eigen::Vector3d operator()(const Eigen::Vector3d& x) const;

 private:
  Eigen::Matrix3Xd centres_;
  Eigen::MatrixX3d coefficients_;  // w, then a_0 and the columns of A
};

}  // namespace relucent::compensation
