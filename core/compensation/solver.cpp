// SPDX-License-Identifier: MIT
#include "compensation/solver.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "base/error.h"
#include "base/parallel.h"

namespace relucent {
namespace {

/// Sum of term(i), the same bits for every number of threads.
template <typename Term>
double sumOf(std::size_t count, const Term& term) {
  constexpr std::size_t chunks = 64;
  std::array<double, chunks> partial{};
  parallelChunks(0, count, chunks, [&](std::size_t chunk, std::size_t begin, std::size_t end) {
    double sum = 0.0;
    for (std::size_t i = begin; i < end; ++i) sum += term(i);
    partial[chunk] = sum;
  });
  return std::accumulate(partial.begin(), partial.end(), 0.0);
}

template <typename Value>
Stack stackOf(std::size_t count, const Value& value) {
  Stack stack(count);
  parallelFor(0, count, 4096, [&](std::size_t i) { stack[i] = value(i); });
  return stack;
}

float clamp01(float value) {
  return std::clamp(value, 0.0f, 1.0f);
}

/// grad f from T x.
Stack gradientFrom(const ConstrainedProblem& problem, const Stack& lit) {
  Stack residual = stackOf(lit.size(), [&](std::size_t i) {
    return problem.weight[i / 3] * (lit[i] - problem.wantedLessBlack[i]);
  });
  Stack g = problem.transport.applyTransposed(residual);
  parallelFor(0, g.size(), 4096, [&](std::size_t j) {
    if (!problem.free[j / 3]) g[j] = 0.0f;
  });
  return g;
}

/// Products with T and sums that both algorithms need, in the metric of the preconditioner.
class Iteration {
 public:
  explicit Iteration(const ConstrainedProblem& problem)
      : problem_(problem), preconditioner_(diagonalPreconditioner(problem)) {
    for (std::uint8_t free : problem.free) freeValues_ += free ? 3 : 0;
  }

  const Stack& preconditioner() const { return preconditioner_; }

  /// x with every value in [0, 1] and the pixels that are not free at 0.
  Stack feasible(const Stack& x) const {
    return stackOf(x.size(), [&](std::size_t j) { return problem_.free[j / 3] ? clamp01(x[j]) : 0.0f; });
  }
  Stack light(const Stack& x) const { return problem_.transport.apply(x); }

  /// f from T x.
  double objective(const Stack& lit) const {
    double f = sumOf(lit.size(), [&](std::size_t i) {
      double r = static_cast<double>(lit[i]) - static_cast<double>(problem_.wantedLessBlack[i]);
      return 0.5 * static_cast<double>(problem_.weight[i / 3]) * r * r;
    });
    if (!std::isfinite(f))
      throw Error(ErrorKind::numerics,
                  "the light transport or the wanted image holds values that are not finite",
                  "measure the venue again");
    return f;
  }
  /// grad f from T x.
  Stack gradientAt(const Stack& lit) const { return gradientFrom(problem_, lit); }
  /// clamp01(x - step C g).
  Stack projectedStep(const Stack& x, const Stack& g, double step) const {
    auto length = static_cast<float>(step);
    return stackOf(x.size(),
                   [&](std::size_t j) { return clamp01(x[j] - length * preconditioner_[j] * g[j]); });
  }
  /// <a - b, C^-1 (c - d)>.
  double metric(const Stack& a, const Stack& b, const Stack& c, const Stack& d) const {
    return sumOf(a.size(), [&](std::size_t j) {
      if (!(preconditioner_[j] > 0.0f)) return 0.0;
      return static_cast<double>(a[j] - b[j]) * static_cast<double>(c[j] - d[j]) /
             static_cast<double>(preconditioner_[j]);
    });
  }
  /// sum_i w_i |(a - b)_i|^2 of two camera stacks.
  double energy(const Stack& a, const Stack& b) const {
    return sumOf(a.size(), [&](std::size_t i) {
      double difference = static_cast<double>(a[i]) - static_cast<double>(b[i]);
      return static_cast<double>(problem_.weight[i / 3]) * difference * difference;
    });
  }
  double projectedGradient(const Stack& x, const Stack& g) const {
    Stack next = projectedStep(x, g, 1.0);
    double sum = sumOf(x.size(), [&](std::size_t j) {
      double change = static_cast<double>(x[j] - next[j]);
      return change * change;
    });
    return freeValues_ > 0 ? std::sqrt(sum / static_cast<double>(freeValues_)) : 0.0;
  }

 private:
  const ConstrainedProblem& problem_;
  Stack preconditioner_;
  std::size_t freeValues_ = 0;
};

/// Progress of something that ends when a norm has fallen below a tolerance or after so many steps.
void reportDescent(Progress& progress, double norm, double firstNorm, int iteration,
                   const SolverSettings& settings) {
  double fallen = 0.0;
  if (firstNorm > settings.tolerance && norm > 0.0)
    fallen = std::log(firstNorm / norm) / std::log(firstNorm / settings.tolerance);
  double counted = static_cast<double>(iteration) / static_cast<double>(settings.mostIterations);
  progress.report(std::clamp(std::max(fallen, counted), 0.0, 1.0));
}

/// Beck & Teboulle's FISTA in the metric of C, restarted where momentum points uphill (O'Donoghue & Candes).
SolveResult solveFista(const Iteration& at, const Stack& start, const SolverSettings& settings,
                       Progress& progress) {
  SolveResult result;
  Stack x = at.feasible(start), lit = at.light(x);
  Stack y = x, litY = lit;
  double t = 1.0, bound = 1.0, firstNorm = 0.0;
  while (result.iterations < settings.mostIterations && !result.converged && !progress.stopAndKeep()) {
    Stack g = at.gradientAt(litY);
    double norm = at.projectedGradient(y, g);
    if (result.iterations == 0) firstNorm = norm;
    result.converged = norm <= settings.tolerance;

    // The bound of one holds for transport without negative entries; measured noise may ask for a little
    // more.
    Stack next, litNext;
    for (;; bound *= 1.5) {
      next = at.projectedStep(y, g, 1.0 / bound);
      litNext = at.light(next);
      if (at.energy(litNext, litY) <= 1.0001 * bound * at.metric(next, y, next, y) || bound > 1e6) break;
    }
    bool uphill = at.metric(y, next, next, x) > 0.0;
    double tNext = uphill ? 1.0 : 0.5 * (1.0 + std::sqrt(1.0 + 4.0 * t * t));
    auto momentum = static_cast<float>(uphill ? 0.0 : (t - 1.0) / tNext);
    y = stackOf(next.size(), [&](std::size_t j) { return next[j] + momentum * (next[j] - x[j]); });
    litY =
        stackOf(litNext.size(), [&](std::size_t i) { return litNext[i] + momentum * (litNext[i] - lit[i]); });
    x = std::move(next);
    lit = std::move(litNext);
    t = tNext;
    ++result.iterations;
    reportDescent(progress, norm, firstNorm, result.iterations, settings);
  }
  result.x = std::move(x);
  return result;
}

/// Barzilai & Borwein's step lengths along the projected gradient (Birgin, Martinez & Raydan); f is
/// quadratic, so the best point of every step is known in closed form and f never rises.
SolveResult solveBarzilaiBorwein(const Iteration& at, const Stack& start, const SolverSettings& settings,
                                 Progress& progress) {
  SolveResult result;
  Stack x = at.feasible(start), lit = at.light(x);
  Stack g = at.gradientAt(lit);
  double step = 1.0, firstNorm = 0.0;
  while (!progress.stopAndKeep()) {
    double norm = at.projectedGradient(x, g);
    if (result.iterations == 0) firstNorm = norm;
    reportDescent(progress, norm, firstNorm, result.iterations, settings);
    result.converged = norm <= settings.tolerance;
    if (result.converged || result.iterations == settings.mostIterations) break;

    Stack trial = at.projectedStep(x, g, step), litTrial = at.light(trial);
    double slope = sumOf(x.size(), [&](std::size_t j) {
      return static_cast<double>(g[j]) * static_cast<double>(trial[j] - x[j]);
    });
    double curvature = at.energy(litTrial, lit);
    auto share = static_cast<float>(curvature > 0.0 ? std::clamp(-slope / curvature, 0.0, 1.0) : 1.0);
    Stack next = stackOf(x.size(), [&](std::size_t j) { return x[j] + share * (trial[j] - x[j]); });
    lit = stackOf(lit.size(), [&](std::size_t i) { return lit[i] + share * (litTrial[i] - lit[i]); });
    Stack gNext = at.gradientAt(lit);

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

void checkShapes(const ConstrainedProblem& problem) {
  std::size_t cameras = problem.transport.cameras().count(),
              projectors = problem.transport.projectors().count();
  require(problem.wantedLessBlack.size() == 3 * cameras && problem.weight.size() == cameras &&
              problem.free.size() == projectors,
          "{} values, {} weights and {} flags for {} camera and {} projector pixels",
          problem.wantedLessBlack.size(), problem.weight.size(), problem.free.size(), cameras, projectors);
}

}  // namespace

std::vector<std::string> problems(const SolverSettings& settings) {
  std::vector<std::string> found;
  if (settings.mostIterations < 1) found.push_back("the solver needs at least one iteration");
  if (!(settings.tolerance > 0.0)) found.push_back("the solver's tolerance must be above 0");
  return found;
}

Stack diagonalPreconditioner(const ConstrainedProblem& problem) {
  checkShapes(problem);
  Stack lit = problem.transport.apply(
      stackOf(3 * problem.free.size(), [&](std::size_t j) { return problem.free[j / 3] ? 1.0f : 0.0f; }));
  Stack row = stackOf(lit.size(), [&](std::size_t i) { return problem.weight[i / 3] * lit[i]; });
  Stack bound = problem.transport.applyTransposed(row);
  float largest = *std::max_element(bound.begin(), bound.end());
  // What sees next to nothing would take steps of any length on rounding errors.
  return stackOf(bound.size(), [&](std::size_t j) {
    return problem.free[j / 3] && bound[j] > 1e-7f * largest ? 1.0f / bound[j] : 0.0f;
  });
}

Stack gradient(const ConstrainedProblem& problem, const Stack& p) {
  checkShapes(problem);
  return gradientFrom(problem, problem.transport.apply(p));
}

SolveResult solveConstrained(const ConstrainedProblem& problem, const Stack& start,
                             const SolverSettings& settings, Progress& progress) {
  auto wrong = problems(settings);
  require(wrong.empty(), "solver settings: {}", fmt::join(wrong, "; "));
  checkShapes(problem);
  require(start.size() == 3 * problem.free.size(), "a start of {} values for {} projector pixels",
          start.size(), problem.free.size());

  Iteration at(problem);
  SolveResult result = settings.algorithm == SolverSettings::Algorithm::fista
                           ? solveFista(at, start, settings, progress)
                           : solveBarzilaiBorwein(at, start, settings, progress);
  Stack first = at.feasible(start);
  double firstObjective = at.objective(at.light(first));
  Stack lit = at.light(result.x);
  result.objective = at.objective(lit);
  if (result.objective > firstObjective) {
    result.x = std::move(first);
    result.objective = firstObjective;
    lit = at.light(result.x);
  }
  result.projectedGradient = at.projectedGradient(result.x, at.gradientAt(lit));
  return result;
}

}  // namespace relucent
