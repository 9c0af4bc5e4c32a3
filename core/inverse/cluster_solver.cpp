// SPDX-License-Identifier: MIT
#include "relucent/inverse/cluster_solver.h"

#include <Eigen/Cholesky>
#include <Eigen/SVD>
#include <cmath>

#include "relucent/base/error.h"

namespace relucent::inverse {
namespace {

/// Below this ridge the conditioning of A^T A, at most 1 / ridge times its size, is more than single floats
/// can take.
constexpr double leastRidgeOfFloats = 1e-2;
/// A row whose weights cancel to less than this share on the flood image is not scaled by what is left.
constexpr float leastUncancelled = 0.2f;

[[noreturn]] void failSingular() {
  throw Error(
      ErrorKind::numerics,
      RELUCENT_ENGLISH_MESSAGE("inverse.cluster-singular",
                               "a cluster of the light transport cannot be inverted"),
      RELUCENT_ENGLISH_MESSAGE("inverse.raise-ridge-or-truncate",
                               "choose a larger ridge, or the truncated singular value decomposition"));
}

template <typename Scalar>
Eigen::MatrixXf ridgeInverse(const Eigen::MatrixXf& block, double lambda) {
  using Matrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;
  Matrix a = block.cast<Scalar>();
  bool tall = a.rows() >= a.cols();
  Eigen::Index side = tall ? a.cols() : a.rows();
  Matrix gram = Matrix::Zero(side, side);
  if (tall)
    gram.template selfadjointView<Eigen::Lower>().rankUpdate(a.transpose());
  else
    gram.template selfadjointView<Eigen::Lower>().rankUpdate(a);
  gram.diagonal().array() += static_cast<Scalar>(lambda);
  Eigen::LLT<Eigen::Ref<Matrix>, Eigen::Lower> factor(gram);
  if (factor.info() != Eigen::Success) failSingular();
  Matrix inverse = tall ? Matrix(factor.solve(a.transpose())) : Matrix(factor.solve(a).transpose());
  if (!inverse.allFinite()) failSingular();
  return inverse.template cast<float>();
}

Eigen::MatrixXf truncatedInverse(const Eigen::MatrixXf& block, double truncation) {
  Eigen::BDCSVD<Eigen::MatrixXd> svd(block.cast<double>(), Eigen::ComputeThinU | Eigen::ComputeThinV);
  Eigen::VectorXd values = svd.singularValues();
  double least = values.size() > 0 ? truncation * values[0] : 0.0;
  // Beside what is asked for, what is nothing but rounding of the largest.
  least = std::max(least, 1e-7 * (values.size() > 0 ? values[0] : 0.0));
  Eigen::VectorXd inverted = values.unaryExpr([&](double s) { return s > least ? 1.0 / s : 0.0; });
  Eigen::MatrixXd inverse = svd.matrixV() * inverted.asDiagonal() * svd.matrixU().transpose();
  if (!inverse.allFinite()) failSingular();
  return inverse.cast<float>();
}

/// Every row of the inverse to 1 on the flood image A 1.
void scaleToWhite(const Eigen::MatrixXf& block, Eigen::MatrixXf& inverse) {
  Eigen::VectorXf flood = block.rowwise().sum();
  Eigen::VectorXf white = inverse * flood;
  Eigen::VectorXf magnitude = inverse.cwiseAbs() * flood.cwiseAbs();
  Eigen::VectorXf seen = block.transpose() * flood;
  for (Eigen::Index j = 0; j < inverse.rows(); ++j) {
    if (white[j] > leastUncancelled * magnitude[j])
      inverse.row(j) /= white[j];
    else if (seen[j] > 0.0f)
      inverse.row(j) = block.col(j).transpose() / seen[j];
    else
      inverse.row(j).setZero();
  }
}

}  // namespace

Eigen::MatrixXf clusterPseudoInverse(const Eigen::MatrixXf& block, double lambda,
                                     const ClusterInverseSettings& settings) {
  if (!block.allFinite()) failSingular();
  // Nothing is seen of these projector pixels, whatever the ridge.
  if (block.size() == 0 || block.isZero(0.0f)) return Eigen::MatrixXf::Zero(block.cols(), block.rows());
  Eigen::MatrixXf inverse;
  if (settings.solver == ClusterSolver::truncatedSvd)
    inverse = truncatedInverse(block, settings.truncation);
  else
    inverse = settings.ridge >= leastRidgeOfFloats ? ridgeInverse<float>(block, lambda)
                                                   : ridgeInverse<double>(block, lambda);
  if (settings.whiteFlood) scaleToWhite(block, inverse);
  return inverse;
}

}  // namespace relucent::inverse
