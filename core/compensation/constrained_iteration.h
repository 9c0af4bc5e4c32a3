// SPDX-License-Identifier: MIT
#pragma once

#include "relucent/compensation/solver.h"
#include "relucent/compensation/stacks.h"

/// Shared by the solvers of solver.h; no other file includes this.
namespace relucent::compensation::detail {

/// grad f from T x; 0 on pixels that are not free.
Stack gradientFrom(const ConstrainedProblem& problem, const Stack& lit);

/// Products with T and sums that the iterative solvers need, in the metric of the preconditioner C.
class Iteration {
 public:
  explicit Iteration(const ConstrainedProblem& problem);

  /// x with every value in [0, 1] and the pixels that are not free at 0.
  Stack feasible(const Stack& x) const;
  Stack light(const Stack& x) const { return problem_.transport.apply(x); }

  /// f from T x. Throws: Error{numerics} if it is not finite.
  double objective(const Stack& lit) const;
  /// grad f from T x.
  Stack gradientAt(const Stack& lit) const { return gradientFrom(problem_, lit); }
  /// clamp01(x - step C g).
  Stack projectedStep(const Stack& x, const Stack& g, double step) const;
  /// <a - b, C^-1 (c - d)>.
  double metric(const Stack& a, const Stack& b, const Stack& c, const Stack& d) const;
  /// sum_i w_i |(a - b)_i|^2 of two camera stacks.
  double energy(const Stack& a, const Stack& b) const;
  /// Root mean square over the free pixels of x - clamp01(x - C g).
  double projectedGradient(const Stack& x, const Stack& g) const;
  /// The optimal share of the step from x to trial, in closed form since f is quadratic.
  double bestShare(const Stack& x, const Stack& trial, const Stack& g, double energyOfStep) const;

 private:
  const ConstrainedProblem& problem_;
  Stack preconditioner_;
  std::size_t freeValues_ = 0;
};

/// Progress of an iteration that ends when a norm falls below a tolerance, or after a number of steps.
void reportDescent(Progress& progress, double norm, double firstNorm, int iteration,
                   const SolverSettings& settings);

/// One algorithm per file. solveConstrained() fills in `objective` and `projectedGradient` of the result.
SolveResult solveFista(const Iteration& at, const Stack& start, const SolverSettings& settings,
                       Progress& progress);
SolveResult solveBarzilaiBorwein(const Iteration& at, const Stack& start, const SolverSettings& settings,
                                 Progress& progress);
SolveResult solveSteepestDescent(const Iteration& at, const Stack& start, const SolverSettings& settings,
                                 Progress& progress);
SolveResult solveDense(const ConstrainedProblem& problem, const Stack& start, const SolverSettings& settings,
                       Progress& progress);

}  // namespace relucent::compensation::detail
