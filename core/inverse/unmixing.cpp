// SPDX-License-Identifier: MIT
#include "relucent/inverse/unmixing.h"

#include <Eigen/LU>

#include "relucent/base/error.h"
#include "relucent/base/parallel.h"

namespace relucent::inverse {

transport::ColourBlock regularisedUnmixing(const transport::ColourBlock& mixing, float share) {
  float norm = mixing.norm();
  if (!(norm > 0.0f)) return transport::ColourBlock::Zero();
  Eigen::Matrix3d b = mixing.cast<double>() / static_cast<double>(norm);
  Eigen::Matrix3d normal = b.transpose() * b;
  normal.diagonal().array() += static_cast<double>(share) * static_cast<double>(share);
  return (normal.inverse() * b.transpose() / static_cast<double>(norm)).cast<float>();
}

CameraStack unmixed(const std::vector<float>& unmixing, const CameraStack& camera) {
  require(unmixing.size() == 3 * camera.size(), "{} values for {} camera pixels", camera.size(),
          unmixing.size() / 9);
  CameraStack result(camera.size());
  parallelFor(0, camera.size() / 3, 1024, [&](std::size_t row) {
    const float* u = &unmixing[9 * row];
    const float* in = &camera[3 * row];
    for (std::size_t c = 0; c < 3; ++c)
      result[3 * row + c] = u[3 * c] * in[0] + u[3 * c + 1] * in[1] + u[3 * c + 2] * in[2];
  });
  return result;
}

}  // namespace relucent::inverse
