// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "relucent/base/enum_names.h"
#include "relucent/base/progress.h"
#include "relucent/transport/transport_matrix.h"

namespace relucent::compensation {

/// Compensation as weighted least squares with box constraints:
///   minimise f(p) = 1/2 sum_i w_i |(T p - b)_i|^2   subject to 0 <= p <= a,   b = wanted - e,
/// a = 1 on free pixels but for those of which not all light is available, 0 on the others.
struct ConstrainedProblem {
  const transport::TransportMatrix& transport;
  const CameraStack& wantedLessBlack;  // b, camera stack
  const std::vector<float>& weight;    // w per camera pixel
  const ProjectorMask& free;           // per projector pixel; pixels with 0 are fixed at 0
  std::span<const float> available{};  // per projector pixel, 0 to 1: Target::available; empty: all
  /// a of a projector pixel.
  float most(std::size_t pixel) const {
    if (!free[pixel]) return 0.0f;
    return available.empty() ? 1.0f : available[pixel];
  }
};

struct SolverSettings {
  enum class Algorithm {
    fista,            // accelerated projected gradient with restart
    barzilaiBorwein,  // projected spectral steps with exact line search
    steepestDescent,  // as in the paper: projected steepest descent with exact line search
    dense,            // active set on the dense matrix: small scale only, ignores the start
  };
  Algorithm algorithm = Algorithm::fista;
  int mostIterations = 200;
  double tolerance = 2e-4;  // of the projected gradient, see SolveResult
};
std::vector<Message> problems(const SolverSettings& settings);

inline constexpr EnumName<SolverSettings::Algorithm> algorithmNames[]{
    {SolverSettings::Algorithm::fista, "fista", "accelerated projected gradient"},
    {SolverSettings::Algorithm::barzilaiBorwein, "spectral", "Barzilai-Borwein"},
    {SolverSettings::Algorithm::steepestDescent, "descent", "the paper's five steps"},
    {SolverSettings::Algorithm::dense, "dense", "small scale"}};
constexpr EnumNames<SolverSettings::Algorithm> namesOf(SolverSettings::Algorithm) {
  return {"solver", algorithmNames};
}

/// Default options of an algorithm. Steepest descent: the five steps of Wetzstein & Bimber 2007, section 3.1,
/// with the step length of Zhang & Nayar 2006. Dense: as many subproblems as needed.
SolverSettings defaultsOf(SolverSettings::Algorithm algorithm);

struct SolveResult {
  ProjectorStack x;
  int iterations = 0;
  bool converged = false;  // the tolerance was met
  double projectedGradient =
      0.0;                 // root mean square over the free pixels of p - clamp(p - C grad f(p)), 0 to a
  double objective = 0.0;  // f
};

/// T^T W T a, with a of the problem: the row sums of the Hessian times a. Shape: projector stack.
/// `weight`: W, one value a camera pixel.
ProjectorStack hessianRowSums(const ConstrainedProblem& problem);
ProjectorStack hessianRowSums(const transport::TransportMatrix& transport, const std::vector<float>& weight,
                              const ProjectorMask& free);

/// C_j = a_j / (T^T W (T a))_j: the diagonal that bounds T^T W T from above for non-negative transport, on
/// pixels with any light, so a step of one never overshoots. 0 where no weighted pixel is seen. Only a
/// diagonal keeps the fixed point of the projected iteration where the constrained optimum is. Shapes:
/// projector stack.  Source: core/compensation/README.md.
ProjectorStack diagonalPreconditioner(const ConstrainedProblem& problem);

/// grad f(p) = T^T W (T p - b), 0 on pixels that are not free.
ProjectorStack gradient(const ConstrainedProblem& problem, const ProjectorStack& p);

/// p <- p - length C grad f(p), not clamped; pixels that are not free stay as they are.
/// `preconditioner`: C, of the same problem.
void takeStep(const ConstrainedProblem& problem, const ProjectorStack& preconditioner, float length,
              ProjectorStack& p);

/// Solves from `start` (clamped first). The result is never worse than the start. Stop and keep: the best so
/// far.
/// Throws: Cancelled; Error{numerics} if T, b or w hold values that are not finite; Error{input} if the
/// problem is too large for the dense algorithm.
SolveResult solveConstrained(const ConstrainedProblem& problem, const ProjectorStack& start,
                             const SolverSettings& settings, Progress& progress);

}  // namespace relucent::compensation
