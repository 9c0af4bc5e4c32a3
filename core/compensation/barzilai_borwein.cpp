// SPDX-License-Identifier: MIT
#include "relucent/compensation/constrained_iteration.h"

namespace relucent::compensation::detail {

/// Barzilai & Borwein's step lengths along the projected gradient (Birgin, Martinez & Raydan); f is
/// quadratic, so the best point of every step is known in closed form and f never rises.
SolveResult solveBarzilaiBorwein(const Iteration& at, const ProjectorStack& start,
                                 const SolverSettings& settings, Progress& progress) {
  SolveResult result;
  ProjectorStack x = at.feasible(start);
  CameraStack lit = at.light(x);
  ProjectorStack g = at.gradientAt(lit);
  double step = 1.0, firstNorm = 0.0;
  while (!progress.stopAndKeep()) {
    double norm = at.projectedGradient(x, g);
    if (result.iterations == 0) firstNorm = norm;
    reportDescent(progress, norm, firstNorm, result.iterations, settings);
    result.converged = norm <= settings.tolerance;
    if (result.converged || result.iterations == settings.mostIterations) break;

    ProjectorStack trial = at.projectedStep(x, g, step);
    CameraStack litTrial = at.light(trial);
    auto share = static_cast<float>(at.bestShare(x, trial, g, at.energy(litTrial, lit)));
    ProjectorStack next =
        stackOf<ProjectorStack>(x.size(), [&](std::size_t j) { return x[j] + share * (trial[j] - x[j]); });
    lit = stackOf<CameraStack>(lit.size(),
                               [&](std::size_t i) { return lit[i] + share * (litTrial[i] - lit[i]); });
    ProjectorStack gNext = at.gradientAt(lit);

    double moved = at.metric(next, x, next, x);
    double bent = sumOf(x.size(), [&](std::size_t j) {
      return static_cast<double>(next[j] - x[j]) * static_cast<double>(gNext[j] - g[j]);
    });
    step = bent > 0.0 ? std::clamp(moved / bent, 1e-2, 1e4) : 1.0;
    x = std::move(next);
    g = std::move(gNext);
    ++result.iterations;
  }
  result.x = std::move(x);
  return result;
}

}  // namespace relucent::compensation::detail
