// SPDX-License-Identifier: MIT
#include "relucent/compensation/colour_spline.h"

#include <Eigen/LU>

#include "relucent/base/require.h"

namespace relucent::compensation {

ColourSpline::ColourSpline(std::span<const Eigen::Vector3d> from, std::span<const Eigen::Vector3d> to,
                           double smoothing) {
  require(from.size() == to.size() && from.size() >= 4 && smoothing >= 0.0,
          "a spline of {} and {} colours, smoothed by {}", from.size(), to.size(), smoothing);
  const auto samples = static_cast<Eigen::Index>(from.size());
  centres_.resize(3, samples);
  for (Eigen::Index m = 0; m < samples; ++m) centres_.col(m) = from[static_cast<std::size_t>(m)];

  Eigen::MatrixXd system = Eigen::MatrixXd::Zero(samples + 4, samples + 4);
  Eigen::MatrixX3d values = Eigen::MatrixX3d::Zero(samples + 4, 3);
  for (Eigen::Index m = 0; m < samples; ++m) {
    system.col(m).head(samples) = -(centres_.colwise() - centres_.col(m)).colwise().norm().transpose();
    system(m, m) = smoothing;
    system(m, samples) = 1.0;
    system.row(m).tail(3) = centres_.col(m).transpose();
    values.row(m) = to[static_cast<std::size_t>(m)].transpose();
  }
  system.bottomLeftCorner(4, samples) = system.topRightCorner(samples, 4).transpose();
  coefficients_ = system.partialPivLu().solve(values);
}

Eigen::Vector3d ColourSpline::operator()(const Eigen::Vector3d& x) const {
  const Eigen::Index samples = centres_.cols();
  Eigen::VectorXd basis(samples + 4);
  basis.head(samples) = -(centres_.colwise() - x).colwise().norm().transpose();
  basis[samples] = 1.0;
  basis.tail(3) = x;
  return coefficients_.transpose() * basis;
}

}  // namespace relucent::compensation
