// SPDX-License-Identifier: MIT
#include <utility>

#include "relucent/compensation/constrained_iteration.h"

namespace relucent::compensation::detail {
namespace {

/// -g without what would leave the box at once.
ProjectorStack feasibleDirection(const Iteration& at, const ProjectorStack& x, const ProjectorStack& g) {
  return stackOf<ProjectorStack>(x.size(), [&](std::size_t j) {
    bool leaves = (x[j] <= 0.0f && g[j] > 0.0f) || (x[j] >= at.most(j) && g[j] < 0.0f);
    return leaves ? 0.0f : -g[j];
  });
}

/// The step at which f is least along the direction: |d|^2 / |T d|^2_W.
float lineMinimum(const Iteration& at, const ProjectorStack& direction) {
  double length = sumOf(direction.size(), [&](std::size_t j) {
    return static_cast<double>(direction[j]) * static_cast<double>(direction[j]);
  });
  CameraStack bent = at.light(direction);
  double curvature = at.energy(bent, CameraStack(bent.size(), 0.0f));
  return curvature > 0.0 ? static_cast<float>(length / curvature) : 0.0f;
}

}  // namespace

SolveResult solveSteepestDescent(const Iteration& at, const ProjectorStack& start,
                                 const SolverSettings& settings, Progress& progress) {
  SolveResult result;
  ProjectorStack x = at.feasible(start);
  CameraStack lit = at.light(x);
  ProjectorStack g = at.gradientAt(lit);
  double firstNorm = 0.0;
  while (!progress.stopAndKeep()) {
    double norm = at.projectedGradient(x, g);
    if (result.iterations == 0) firstNorm = norm;
    reportDescent(progress, norm, firstNorm, result.iterations, settings);
    result.converged = norm <= settings.tolerance;
    if (result.converged || result.iterations == settings.mostIterations) break;

    ProjectorStack direction = feasibleDirection(at, x, g);
    float step = lineMinimum(at, direction);
    ProjectorStack trial = stackOf<ProjectorStack>(
        x.size(), [&](std::size_t j) { return at.held(x[j] + step * direction[j], j); });

    // Where clamping bent the line, its minimum lies elsewhere, and f might have risen.
    CameraStack litTrial = at.light(trial);
    auto share = static_cast<float>(at.bestShare(x, trial, g, at.energy(litTrial, lit)));
    parallelFor(0, x.size(), 4096, [&](std::size_t j) { x[j] += share * (trial[j] - x[j]); });
    parallelFor(0, lit.size(), 4096, [&](std::size_t i) { lit[i] += share * (litTrial[i] - lit[i]); });
    g = at.gradientAt(lit);
    ++result.iterations;
  }
  result.x = std::move(x);
  return result;
}

}  // namespace relucent::compensation::detail
