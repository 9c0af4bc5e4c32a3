// SPDX-License-Identifier: MIT
#include <cmath>

#include "relucent/base/error.h"
#include "relucent/compensation/constrained_iteration.h"
#include "relucent/compensation/dense_box.h"

namespace relucent::compensation::detail {
namespace {

constexpr std::size_t mostUnknowns = 1536;
constexpr std::size_t mostValues = std::size_t{1} << 26;  // half a gigabyte

std::vector<std::size_t> freeValues(const ConstrainedProblem& problem) {
  std::vector<std::size_t> places;
  for (std::size_t j = 0; j < problem.free.size(); ++j)
    if (problem.most(j) > 0.0f)
      for (std::size_t c = 0; c < 3; ++c) places.push_back(3 * j + c);
  return places;
}

std::vector<std::size_t> weightedValues(const ConstrainedProblem& problem) {
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < problem.weight.size(); ++i)
    if (problem.weight[i] != 0.0f)  // NaN stays in, to be complained about
      for (std::size_t c = 0; c < 3; ++c) places.push_back(3 * i + c);
  return places;
}

}  // namespace

SolveResult solveDense(const ConstrainedProblem& problem, const ProjectorStack& start,
                       const SolverSettings& settings, Progress& progress) {
  std::vector<std::size_t> columns = freeValues(problem), rows = weightedValues(problem);
  if (columns.size() > mostUnknowns || columns.size() * rows.size() > mostValues)
    throw Error(ErrorKind::input,
                RELUCENT_ENGLISH_MESSAGE(
                    "compensation.dense-problem-too-large",
                    "{} unknowns from {} values are too many for the dense solver, which takes {}")
                    .with(columns.size(), rows.size(), mostUnknowns),
                RELUCENT_ENGLISH_MESSAGE("compensation.change-solver-or-shrink-content",
                                         "choose another solver, or place the content on fewer pixels"));

  // sqrt(W) T diag(a), a column for every value that can be lit: what is solved for is p / a, between 0
  // and 1.
  Eigen::MatrixXd a(static_cast<Eigen::Index>(rows.size()), static_cast<Eigen::Index>(columns.size()));
  Eigen::VectorXd b(a.rows());
  auto root = [&](std::size_t i) { return std::sqrt(static_cast<double>(problem.weight[rows[i] / 3])); };
  for (std::size_t i = 0; i < rows.size(); ++i)
    b[static_cast<Eigen::Index>(i)] = root(i) * static_cast<double>(problem.wantedLessBlack[rows[i]]);
  Progress assembling = progress.part(
      0.2, RELUCENT_MESSAGE("stage.writing-out-light-transport", "Writing out the light transport"));
  ProjectorStack one(start.size(), 0.0f);
  for (std::size_t j = 0; j < columns.size(); ++j) {
    assembling.report(static_cast<double>(j) / static_cast<double>(columns.size()));
    one[columns[j]] = problem.most(columns[j] / 3);
    CameraStack lit = problem.transport.apply(one);
    one[columns[j]] = 0.0f;
    for (std::size_t i = 0; i < rows.size(); ++i)
      a(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
          root(i) * static_cast<double>(lit[rows[i]]);
  }

  SolveResult result;
  result.x.assign(start.size(), 0.0f);
  if (progress.stopAndKeep()) {
    for (std::size_t j : columns) result.x[j] = std::min(clamp01(start[j]), problem.most(j / 3));
    return result;
  }
  DenseBoxSettings dense;
  dense.mostIterations = settings.mostIterations;
  Progress solving = progress.part(0.8, RELUCENT_MESSAGE("stage.solving", "Solving"));
  DenseBoxResult solved = solveDenseBox(a, b, dense, solving);
  for (std::size_t j = 0; j < columns.size(); ++j)
    result.x[columns[j]] =
        problem.most(columns[j] / 3) * static_cast<float>(solved.x[static_cast<Eigen::Index>(j)]);
  result.iterations = solved.iterations;
  result.converged = solved.converged;
  return result;
}

}  // namespace relucent::compensation::detail
