// SPDX-License-Identifier: MIT
#include <cmath>

#include "relucent/compensation/constrained_iteration.h"

namespace relucent::compensation::detail {

/// Beck & Teboulle's FISTA in the metric of C, restarted where momentum points uphill (O'Donoghue & Candes).
SolveResult solveFista(const Iteration& at, const ProjectorStack& start, const SolverSettings& settings,
                       Progress& progress) {
  SolveResult result;
  ProjectorStack x = at.feasible(start), y = x;
  CameraStack lit = at.light(x), litY = lit;
  double t = 1.0, bound = 1.0, firstNorm = 0.0;
  while (result.iterations < settings.mostIterations && !result.converged && !progress.stopAndKeep()) {
    ProjectorStack g = at.gradientAt(litY);
    double norm = at.projectedGradient(y, g);
    if (result.iterations == 0) firstNorm = norm;
    result.converged = norm <= settings.tolerance;

    // The bound of one holds for transport without negative entries; measured noise may ask for a little
    // more.
    ProjectorStack next;
    CameraStack litNext;
    for (;; bound *= 1.5) {
      next = at.projectedStep(y, g, 1.0 / bound);
      litNext = at.light(next);
      if (at.energy(litNext, litY) <= 1.0001 * bound * at.metric(next, y, next, y) || bound > 1e6) break;
    }
    bool uphill = at.metric(y, next, next, x) > 0.0;
    double tNext = uphill ? 1.0 : 0.5 * (1.0 + std::sqrt(1.0 + 4.0 * t * t));
    auto momentum = static_cast<float>(uphill ? 0.0 : (t - 1.0) / tNext);
    y = stackOf<ProjectorStack>(next.size(),
                                [&](std::size_t j) { return next[j] + momentum * (next[j] - x[j]); });
    litY = stackOf<CameraStack>(litNext.size(),
                                [&](std::size_t i) { return litNext[i] + momentum * (litNext[i] - lit[i]); });
    x = std::move(next);
    lit = std::move(litNext);
    t = tNext;
    ++result.iterations;
    reportDescent(progress, norm, firstNorm, result.iterations, settings);
  }
  result.x = std::move(x);
  return result;
}

}  // namespace relucent::compensation::detail
