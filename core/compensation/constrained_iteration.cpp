// SPDX-License-Identifier: MIT
#include "relucent/compensation/constrained_iteration.h"

#include <cmath>

#include "relucent/base/error.h"

namespace relucent::compensation::detail {

ProjectorStack gradientFrom(const ConstrainedProblem& problem, const CameraStack& lit) {
  CameraStack residual = stackOf<CameraStack>(lit.size(), [&](std::size_t i) {
    return problem.weight[i / 3] * (lit[i] - problem.wantedLessBlack[i]);
  });
  ProjectorStack g = problem.transport.applyTransposed(residual);
  parallelFor(0, g.size(), 4096, [&](std::size_t j) {
    if (!problem.free[j / 3]) g[j] = 0.0f;
  });
  return g;
}

Iteration::Iteration(const ConstrainedProblem& problem)
    : problem_(problem), preconditioner_(diagonalPreconditioner(problem)) {
  for (std::size_t j = 0; j < problem.free.size(); ++j) freeValues_ += problem.most(j) > 0.0f ? 3 : 0;
}

ProjectorStack Iteration::feasible(const ProjectorStack& x) const {
  return stackOf<ProjectorStack>(x.size(), [&](std::size_t j) { return held(x[j], j); });
}

double Iteration::objective(const CameraStack& lit) const {
  double f = sumOf(lit.size(), [&](std::size_t i) {
    double r = static_cast<double>(lit[i]) - static_cast<double>(problem_.wantedLessBlack[i]);
    return 0.5 * static_cast<double>(problem_.weight[i / 3]) * r * r;
  });
  if (!std::isfinite(f))
    throw Error(
        ErrorKind::numerics,
        RELUCENT_ENGLISH_MESSAGE("compensation.values-not-finite",
                                 "the light transport or the wanted image holds values that are not finite"),
        RELUCENT_ENGLISH_MESSAGE("compensation.measure-venue-again", "measure the venue again"));
  return f;
}

ProjectorStack Iteration::projectedStep(const ProjectorStack& x, const ProjectorStack& g, double step) const {
  auto length = static_cast<float>(step);
  return stackOf<ProjectorStack>(
      x.size(), [&](std::size_t j) { return held(x[j] - length * preconditioner_[j] * g[j], j); });
}

double Iteration::metric(const ProjectorStack& a, const ProjectorStack& b, const ProjectorStack& c,
                         const ProjectorStack& d) const {
  return sumOf(a.size(), [&](std::size_t j) {
    if (!(preconditioner_[j] > 0.0f)) return 0.0;
    return static_cast<double>(a[j] - b[j]) * static_cast<double>(c[j] - d[j]) /
           static_cast<double>(preconditioner_[j]);
  });
}

double Iteration::energy(const CameraStack& a, const CameraStack& b) const {
  return sumOf(a.size(), [&](std::size_t i) {
    double difference = static_cast<double>(a[i]) - static_cast<double>(b[i]);
    return static_cast<double>(problem_.weight[i / 3]) * difference * difference;
  });
}

double Iteration::projectedGradient(const ProjectorStack& x, const ProjectorStack& g) const {
  ProjectorStack next = projectedStep(x, g, 1.0);
  double sum = sumOf(x.size(), [&](std::size_t j) {
    double change = static_cast<double>(x[j] - next[j]);
    return change * change;
  });
  return freeValues_ > 0 ? std::sqrt(sum / static_cast<double>(freeValues_)) : 0.0;
}

double Iteration::bestShare(const ProjectorStack& x, const ProjectorStack& trial, const ProjectorStack& g,
                            double energyOfStep) const {
  double slope = sumOf(x.size(), [&](std::size_t j) {
    return static_cast<double>(g[j]) * static_cast<double>(trial[j] - x[j]);
  });
  return energyOfStep > 0.0 ? std::clamp(-slope / energyOfStep, 0.0, 1.0) : 1.0;
}

void reportDescent(Progress& progress, double norm, double firstNorm, int iteration,
                   const SolverSettings& settings) {
  double fallen = 0.0;
  if (firstNorm > settings.tolerance && norm > 0.0)
    fallen = std::log(firstNorm / norm) / std::log(firstNorm / settings.tolerance);
  double counted = static_cast<double>(iteration) / static_cast<double>(settings.mostIterations);
  progress.report(std::clamp(std::max(fallen, counted), 0.0, 1.0));
}

}  // namespace relucent::compensation::detail
