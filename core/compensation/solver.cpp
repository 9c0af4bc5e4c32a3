// SPDX-License-Identifier: MIT
#include "relucent/compensation/solver.h"

#include <algorithm>
#include <utility>

#include "relucent/base/error.h"
#include "relucent/base/parallel.h"
#include "relucent/compensation/constrained_iteration.h"

namespace relucent::compensation {
namespace {

using Algorithm = SolverSettings::Algorithm;

void checkShapes(const ConstrainedProblem& problem) {
  std::size_t cameras = problem.transport.cameras().count(),
              projectors = problem.transport.projectors().count();
  require(problem.wantedLessBlack.size() == 3 * cameras && problem.weight.size() == cameras &&
              problem.free.size() == projectors &&
              (problem.available.empty() || problem.available.size() == projectors),
          "{} values, {} weights and {} flags for {} camera and {} projector pixels",
          problem.wantedLessBlack.size(), problem.weight.size(), problem.free.size(), cameras, projectors);
}

SolveResult solveBy(Algorithm algorithm, const detail::Iteration& at, const ConstrainedProblem& problem,
                    const ProjectorStack& start, const SolverSettings& settings, Progress& progress) {
  switch (algorithm) {
    case Algorithm::barzilaiBorwein:
      return detail::solveBarzilaiBorwein(at, start, settings, progress);
    case Algorithm::steepestDescent:
      return detail::solveSteepestDescent(at, start, settings, progress);
    case Algorithm::dense:
      return detail::solveDense(problem, start, settings, progress);
    case Algorithm::fista:
      break;
  }
  return detail::solveFista(at, start, settings, progress);
}

}  // namespace

std::vector<Message> problems(const SolverSettings& settings) {
  std::vector<Message> found;
  if (settings.mostIterations < 1)
    found.push_back(RELUCENT_ENGLISH_MESSAGE("compensation.solver-iterations-not-positive",
                                             "the solver needs at least one iteration"));
  if (!(settings.tolerance > 0.0))
    found.push_back(RELUCENT_ENGLISH_MESSAGE("compensation.solver-tolerance-not-positive",
                                             "the solver's tolerance must be above 0"));
  return found;
}

SolverSettings defaultsOf(SolverSettings::Algorithm algorithm) {
  SolverSettings settings;
  settings.algorithm = algorithm;
  if (algorithm == Algorithm::steepestDescent) settings.mostIterations = 5;
  if (algorithm == Algorithm::dense) settings.mostIterations = 20000;
  return settings;
}

ProjectorStack hessianRowSums(const ConstrainedProblem& problem) {
  const CameraStack lit = problem.transport.apply(
      stackOf<ProjectorStack>(3 * problem.free.size(), [&](std::size_t j) { return problem.most(j / 3); }));
  return problem.transport.applyTransposed(
      stackOf<CameraStack>(lit.size(), [&](std::size_t i) { return problem.weight[i / 3] * lit[i]; }));
}

ProjectorStack hessianRowSums(const transport::TransportMatrix& transport, const std::vector<float>& weight,
                              const ProjectorMask& free) {
  return hessianRowSums({transport, CameraStack(), weight, free});
}

ProjectorStack diagonalPreconditioner(const ConstrainedProblem& problem) {
  checkShapes(problem);
  const ProjectorStack bound = hessianRowSums(problem);
  float largest = bound.empty() ? 0.0f : *std::max_element(bound.begin(), bound.end());
  // What sees next to nothing would take steps of any length on rounding errors.
  return stackOf<ProjectorStack>(bound.size(), [&](std::size_t j) {
    return problem.free[j / 3] && bound[j] > 1e-7f * largest ? problem.most(j / 3) / bound[j] : 0.0f;
  });
}

ProjectorStack gradient(const ConstrainedProblem& problem, const ProjectorStack& p) {
  checkShapes(problem);
  return detail::gradientFrom(problem, problem.transport.apply(p));
}

void takeStep(const ConstrainedProblem& problem, const ProjectorStack& preconditioner, float length,
              ProjectorStack& p) {
  const ProjectorStack g = gradient(problem, p);
  parallelFor(0, g.size(), 4096, [&](std::size_t j) { p[j] -= length * preconditioner[j] * g[j]; });
}

SolveResult solveConstrained(const ConstrainedProblem& problem, const ProjectorStack& start,
                             const SolverSettings& settings, Progress& progress) {
  auto wrong = problems(settings);
  require(wrong.empty(), "solver settings: {}", fmt::join(wrong, "; "));
  checkShapes(problem);
  require(start.size() == 3 * problem.free.size(), "a start of {} values for {} projector pixels",
          start.size(), problem.free.size());

  detail::Iteration at(problem);
  ProjectorStack first = at.feasible(start);
  double firstObjective = at.objective(at.light(first));
  SolveResult result = solveBy(settings.algorithm, at, problem, start, settings, progress);
  CameraStack lit = at.light(result.x);
  result.objective = at.objective(lit);
  if (result.objective > firstObjective) {
    result.x = std::move(first);
    result.objective = firstObjective;
    lit = at.light(result.x);
  }
  result.projectedGradient = at.projectedGradient(result.x, at.gradientAt(lit));
  return result;
}

}  // namespace relucent::compensation
