// SPDX-License-Identifier: MIT
#pragma once

#include "relucent/compensation/solver.h"
#include "relucent/compensation/stacks.h"

/// Shared by the solvers of solver.h; no other file includes this.
namespace relucent::compensation::detail {

/// grad f from T x; 0 on pixels that are not free.
ProjectorStack gradientFrom(const ConstrainedProblem& problem, const CameraStack& lit);

/// Products with T and sums that the iterative solvers need, in the metric of the preconditioner C.
class Iteration {
 public:
  explicit Iteration(const ConstrainedProblem& problem);

  /// A value of x, held between 0 and a.
  float held(float value, std::size_t j) const { return std::clamp(value, 0.0f, problem_.most(j / 3)); }
  /// a of a value of x.
  float most(std::size_t j) const { return problem_.most(j / 3); }
  /// x with every value held.
  ProjectorStack feasible(const ProjectorStack& x) const;
  CameraStack light(const ProjectorStack& x) const { return problem_.transport.apply(x); }

  /// f from T x. Throws: Error{numerics} if it is not finite.
  double objective(const CameraStack& lit) const;
  /// grad f from T x.
  ProjectorStack gradientAt(const CameraStack& lit) const { return gradientFrom(problem_, lit); }
  /// x - step C g, held between 0 and a.
  ProjectorStack projectedStep(const ProjectorStack& x, const ProjectorStack& g, double step) const;
  /// <a - b, C^-1 (c - d)>.
  double metric(const ProjectorStack& a, const ProjectorStack& b, const ProjectorStack& c,
                const ProjectorStack& d) const;
  /// sum_i w_i |(a - b)_i|^2 of two camera stacks.
  double energy(const CameraStack& a, const CameraStack& b) const;
  /// Root mean square over the free pixels of x - projectedStep(x, g, 1).
  double projectedGradient(const ProjectorStack& x, const ProjectorStack& g) const;
  /// The optimal share of the step from x to trial, in closed form since f is quadratic.
  double bestShare(const ProjectorStack& x, const ProjectorStack& trial, const ProjectorStack& g,
                   double energyOfStep) const;

 private:
  const ConstrainedProblem& problem_;
  ProjectorStack preconditioner_;
  std::size_t freeValues_ = 0;
};

/// Progress of an iteration that ends when a norm falls below a tolerance, or after a number of steps.
void reportDescent(Progress& progress, double norm, double firstNorm, int iteration,
                   const SolverSettings& settings);

/// One algorithm per file. solveConstrained() fills in `objective` and `projectedGradient` of the result.
SolveResult solveFista(const Iteration& at, const ProjectorStack& start, const SolverSettings& settings,
                       Progress& progress);
SolveResult solveBarzilaiBorwein(const Iteration& at, const ProjectorStack& start,
                                 const SolverSettings& settings, Progress& progress);
SolveResult solveSteepestDescent(const Iteration& at, const ProjectorStack& start,
                                 const SolverSettings& settings, Progress& progress);
SolveResult solveDense(const ConstrainedProblem& problem, const ProjectorStack& start,
                       const SolverSettings& settings, Progress& progress);

}  // namespace relucent::compensation::detail
