// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/LU>

#include "relucent/transport/transport_matrix.h"

namespace relucent::compensation {

/// B^-1 of one camera pixel; 0 where no colours can be told apart.
inline Eigen::Matrix3f inverseMixing(const transport::ColourBlock& mixing) {
  Eigen::Matrix3f inverse;
  bool invertible = false;
  Eigen::Matrix3f(mixing).computeInverseWithCheck(inverse, invertible, 1e-12f);
  return invertible ? inverse : Eigen::Matrix3f::Zero();
}

}  // namespace relucent::compensation
