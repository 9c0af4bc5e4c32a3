// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include "relucent/inverse/cluster_inverse.h"

namespace relucent::inverse {

/// Regularised inverse of one cluster's matrix (see computeClusterInverse()), scaled to white on request.
/// Shapes: rows x columns -> columns x rows.  `lambda`: absolute, for the ridge.
/// Throws: Error{numerics} if A^T A + lambda I cannot be factored.
Eigen::MatrixXf clusterPseudoInverse(const Eigen::MatrixXf& block, double lambda,
                                     const ClusterInverseSettings& settings);

}  // namespace relucent::inverse
