// SPDX-License-Identifier: MIT
#include "inverse/smooth_prior.h"

#include <cmath>

#include "base/error.h"

namespace relucent {

SmoothPrior::SmoothPrior(double reach)
    : kept_(static_cast<float>(std::exp(-1.0 / reach))),
      fresh_(static_cast<float>(std::sqrt(1.0 - std::exp(-2.0 / reach)))) {
  require(reach > 0.0, "a prior's reach of {} pixels", reach);
}

// L: p_k = kept p_(k-1) + fresh w_k, p_0 = w_0. A row vector times L runs that backwards.
void SmoothPrior::timesRoot(Eigen::MatrixXf& t, Size raster) const {
  auto handOn = [&](int pixel, int step) {
    t.col(pixel) += kept_ * t.col(pixel + step);
    t.col(pixel + step) *= fresh_;
  };
  for (int y = 0; y < raster.height; ++y)
    for (int x = raster.width - 2; x >= 0; --x) handOn(y * raster.width + x, 1);
  for (int y = raster.height - 2; y >= 0; --y)
    for (int x = 0; x < raster.width; ++x) handOn(y * raster.width + x, raster.width);
}

void SmoothPrior::timesRootTransposed(Eigen::MatrixXf& t, Size raster) const {
  auto takeOver = [&](int pixel, int step) {
    t.col(pixel) = fresh_ * t.col(pixel) + kept_ * t.col(pixel - step);
  };
  for (int y = 0; y < raster.height; ++y)
    for (int x = 1; x < raster.width; ++x) takeOver(y * raster.width + x, 1);
  for (int y = 1; y < raster.height; ++y)
    for (int x = 0; x < raster.width; ++x) takeOver(y * raster.width + x, raster.width);
}

float SmoothPrior::spreadOfMean(int side) const {
  // The covariance is a product: the variance of the mean is the square of that of a line of pixels.
  double n = side, k = static_cast<double>(kept_);
  double line = (n * (1.0 - k * k) - 2.0 * k * (1.0 - std::pow(k, n))) / (n * n * (1.0 - k) * (1.0 - k));
  return static_cast<float>(line);
}

}  // namespace relucent
