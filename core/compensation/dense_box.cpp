// SPDX-License-Identifier: MIT
#include "relucent/compensation/dense_box.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "relucent/base/error.h"

namespace relucent::compensation {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// The state of an active-set solution; x never leaves the box.
class ActiveSet {
 public:
  ActiveSet(const Eigen::MatrixXd& a, const VectorXd& b, const DenseBoxSettings& settings)
      : a_(a),
        b_(b),
        settings_(settings),
        gram_(a.transpose() * a),
        x_(VectorXd::Constant(a.cols(), settings.lower)),
        free_(static_cast<std::size_t>(a.cols()), 1) {
    largest_ = gram_.size() > 0 ? gram_.diagonal().maxCoeff() : 0.0;
    // A column that is next to nothing decides nothing; its value stays where it is.
    for (Index j = 0; j < gram_.rows(); ++j)
      if (!(gram_(j, j) > negligible * largest_)) fix(j);
  }

  const VectorXd& x() const { return x_; }
  VectorXd gradient() const { return a_.transpose() * (a_ * x_ - b_); }
  double objective() const { return 0.5 * (a_ * x_ - b_).squaredNorm(); }

  /// Per value how far a step of its own would move it, and the largest of them.
  double optimality() const {
    VectorXd g = gradient();
    double worst = 0.0;
    for (Index j = 0; j < x_.size(); ++j) worst = std::max(worst, std::abs(ownStep(j, g[j])));
    return worst;
  }

  /// Step 1: the free solution with everything that leaves the box fixed where it left. True when nothing
  /// left.
  bool solveAndClamp() {
    VectorXd wanted = subproblem();
    bool inside = true;
    for (Index j = 0; j < x_.size(); ++j) {
      if (!isFree(j)) continue;
      bool leaves = wanted[j] < settings_.lower || wanted[j] > settings_.upper;
      x_[j] = std::clamp(wanted[j], settings_.lower, settings_.upper);
      if (leaves) fix(j);
      inside = inside && !leaves;
    }
    return inside;
  }

  /// Step 2: frees the fixed value that gains most. False if none gains.
  bool release() {
    VectorXd g = gradient();
    Index best = -1;
    double most = settings_.tolerance;
    for (Index j = 0; j < x_.size(); ++j) {
      double step = isFree(j) || j == refused_ ? 0.0 : std::abs(ownStep(j, g[j]));
      if (step <= most) continue;
      most = step;
      best = j;
    }
    released_ = best;
    if (best >= 0) free_[static_cast<std::size_t>(best)] = 1;
    return best >= 0;
  }

  /// Step 3: towards the free solution as far as the box allows. True when it was reached.
  bool advance() {
    VectorXd wanted = subproblem();
    double share = 1.0;
    Index meets = -1;
    for (Index j = 0; j < x_.size(); ++j) {
      if (!isFree(j)) continue;
      double bound = wanted[j] < settings_.lower ? settings_.lower : settings_.upper;
      if (wanted[j] >= settings_.lower && wanted[j] <= settings_.upper) continue;
      double reach = (bound - x_[j]) / (wanted[j] - x_[j]);
      if (reach >= share) continue;
      share = reach;
      meets = j;
    }
    for (Index j = 0; j < x_.size(); ++j)
      if (isFree(j))
        x_[j] = std::clamp(x_[j] + share * (wanted[j] - x_[j]), settings_.lower, settings_.upper);
    if (meets >= 0) {
      x_[meets] = wanted[meets] < settings_.lower ? settings_.lower : settings_.upper;
      fix(meets);
    }
    // A value that turns back at once was released by a rounding error; it must not be chosen for ever.
    refused_ = meets >= 0 && meets == released_ ? meets : (meets < 0 ? -1 : refused_);
    return meets < 0;
  }

 private:
  static constexpr double negligible = 1e-24;
  static constexpr double ridge = 1e-12;

  bool isFree(Index j) const { return free_[static_cast<std::size_t>(j)] != 0; }
  void fix(Index j) { free_[static_cast<std::size_t>(j)] = 0; }

  double ownStep(Index j, double gradient) const {
    if (!(gram_(j, j) > negligible * largest_)) return 0.0;
    return std::clamp(x_[j] - gradient / gram_(j, j), settings_.lower, settings_.upper) - x_[j];
  }

  /// x with the free values at the least squares, whatever the box says.
  VectorXd subproblem() const {
    std::vector<Index> free;
    for (Index j = 0; j < x_.size(); ++j)
      if (isFree(j)) free.push_back(j);
    VectorXd x = x_;
    if (free.empty()) return x;

    Eigen::MatrixXd part = gram_(free, free);
    part.diagonal().array() += ridge * largest_;
    Eigen::LLT<Eigen::MatrixXd> factor(part);
    if (factor.info() != Eigen::Success)
      throw Error(ErrorKind::numerics,
                  RELUCENT_ENGLISH_MESSAGE("compensation.dense-factorization-failed",
                                           "a dense least-squares problem cannot be factored"),
                  RELUCENT_ENGLISH_MESSAGE("compensation.choose-another-solver", "choose another solver"));
    constexpr int mostCorrections = 10;
    for (int i = 0; i < mostCorrections; ++i) {
      VectorXd residual = a_.transpose() * (b_ - a_ * x);
      VectorXd change = factor.solve(VectorXd(residual(free)));
      x(free) += change;
      if (change.lpNorm<Eigen::Infinity>() <= 1e-13 * (1.0 + x.lpNorm<Eigen::Infinity>())) break;
    }
    return x;
  }

  const Eigen::MatrixXd& a_;
  const VectorXd& b_;
  const DenseBoxSettings& settings_;
  Eigen::MatrixXd gram_;
  double largest_ = 0.0;
  VectorXd x_;
  std::vector<std::uint8_t> free_;
  Index released_ = -1;  // by the last release()
  Index refused_ = -1;   // not to be released before something else has changed
};

}  // namespace

std::vector<Message> problems(const DenseBoxSettings& settings) {
  std::vector<Message> found;
  if (!(settings.lower < settings.upper))
    found.push_back(RELUCENT_ENGLISH_MESSAGE("compensation.bounds-out-of-order",
                                             "the lower bound must lie below the upper"));
  if (!(settings.tolerance > 0.0))
    found.push_back(RELUCENT_ENGLISH_MESSAGE("compensation.dense-tolerance-not-positive",
                                             "the dense solver's tolerance must be above 0"));
  if (settings.mostIterations < 0)
    found.push_back(
        RELUCENT_ENGLISH_MESSAGE("compensation.dense-iterations-negative",
                                 "the number of the dense solver's iterations cannot be negative"));
  return found;
}

DenseBoxResult solveDenseBox(const Eigen::MatrixXd& a, const VectorXd& b, const DenseBoxSettings& settings,
                             Progress& progress) {
  auto wrong = problems(settings);
  require(wrong.empty(), "dense solver settings: {}", fmt::join(wrong, "; "));
  require(a.rows() == b.size(), "a matrix of {} rows and {} values", a.rows(), b.size());
  if (!a.allFinite() || !b.allFinite())
    throw Error(ErrorKind::numerics,
                RELUCENT_ENGLISH_MESSAGE("compensation.dense-values-not-finite",
                                         "a least-squares problem holds values that are not finite"),
                RELUCENT_ENGLISH_MESSAGE("compensation.measure-venue-again", "measure the venue again"));

  DenseBoxResult result;
  ActiveSet set(a, b, settings);
  int most = settings.mostIterations > 0 ? settings.mostIterations : 10 * static_cast<int>(a.cols()) + 10;
  auto goOn = [&] {
    // How many subproblems it will take is not known: half of what is left each time.
    progress.report(1.0 - 1.0 / (1.0 + 4.0 * result.iterations / (1.0 + static_cast<double>(a.cols()))));
    return result.iterations < most && !progress.stopAndKeep();
  };
  bool inside = a.cols() == 0;
  while (!inside && goOn()) {
    inside = set.solveAndClamp();
    ++result.iterations;
  }
  while (inside && goOn() && set.release()) {
    inside = false;
    while (!inside && goOn()) {
      inside = set.advance();
      ++result.iterations;
    }
  }
  result.x = set.x();
  result.optimality = set.optimality();
  result.objective = set.objective();
  result.converged = result.optimality <= settings.tolerance;
  return result;
}

}  // namespace relucent::compensation
