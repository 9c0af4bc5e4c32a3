// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "relucent/base/progress.h"

namespace relucent::compensation {

struct DenseBoxSettings {
  double lower = 0.0;
  double upper = 1.0;
  double tolerance = 1e-9;  // of the optimality, see DenseBoxResult
  int mostIterations = 0;   // 0: ten times the number of unknowns
};
std::vector<Message> problems(const DenseBoxSettings& settings);

struct DenseBoxResult {
  Eigen::VectorXd x;
  int iterations = 0;       // solved subproblems
  bool converged = false;   // the tolerance was met
  double optimality = 0.0;  // max over j of |x_j - clamp(x_j - g_j / G_jj)|, g the gradient, G = A^T A
  double objective = 0.0;   // 1/2 |A x - b|^2
};

/// Dense least squares in a box,  minimise 1/2 |A x - b|^2  subject to  lower <= x <= upper,  by an active
/// set: non-negative least squares (Lawson & Hanson 1974) with a second bound (Stark & Parker 1995).
///  1. Solve without bounds, fix values that leave the box at the bound that they passed, repeat until none
///  leaves.
///  2. Free the fixed value whose gradient points most strongly into the box. None: done.
///  3. Solve for the free values. If that leaves the box, stop at the first bound, fix what reached
///     it there, and repeat 3; then 2.
/// Subproblems are solved by Cholesky factors of G with a ridge of 1e-12 of its largest diagonal value, and
/// then corrected by their own residuals, so that the ridge has no effect where columns are independent;
/// where they are not, x stays near its previous value. For reference and small scale: memory is that of A
/// and G, time one factorisation of the free part of G per iteration.
/// Shapes: A m x n, b m, x n; either may be 0.  Stop and keep: the best so far, always within the box.
/// Source: core/compensation/README.md.
/// Throws: Cancelled; Error{numerics} if A or b hold values that are not finite.
DenseBoxResult solveDenseBox(const Eigen::MatrixXd& a, const Eigen::VectorXd& b,
                             const DenseBoxSettings& settings, Progress& progress);

}  // namespace relucent::compensation
