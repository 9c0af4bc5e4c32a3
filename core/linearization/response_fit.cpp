// SPDX-License-Identifier: MIT
#include "relucent/linearization/response_fit.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "relucent/base/error.h"

namespace relucent::linearization {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double roughness = 7e-4;     // a priori, of what four neighbours say about a level
constexpr double firstFlicker = 3e-3;  // a priori, until the photographs say better
constexpr double leastFlicker = 2e-4;  // what no lamp beats
constexpr double mostFlicker = 0.1;
constexpr int flickerRounds = 6;
constexpr int mostSteps = 40;

Index toIndex(std::size_t value) {
  return static_cast<Index>(value);
}

/// The products over the noise: every photograph's noise has the variance 1 in each value.
MatrixXd whitened(const LightProducts& products) {
  Index shots = toIndex(products.shots());
  MatrixXd result(shots, shots);
  auto scale = [&](std::size_t m) { return std::sqrt(products.values() / products.noise(m)); };
  for (std::size_t m = 0; m < products.shots(); ++m)
    for (std::size_t n = 0; n < products.shots(); ++n)
      result(toIndex(m), toIndex(n)) = products.at(m, n) * scale(m) * scale(n);
  return result;
}

VectorXd scalesOf(const LightProducts& products) {
  VectorXd scales(toIndex(products.shots()));
  for (std::size_t m = 0; m < products.shots(); ++m)
    scales[toIndex(m)] = std::sqrt(products.values() / products.noise(m));
  return scales;
}

/// chi^2 at X and, with U = dX / d parameters (a row for each of X's elements, light after light), its
/// gradient and the approximation of its curvature that Kaufman gives:
///   Q = I - X^+ X,  gradient/2 = -U^T vec(X^+^T C Q),  curvature/2 = U^T (X^+^T C X^+ (x) Q) U
class Projection {
 public:
  Projection(const MatrixXd& products, const MatrixXd& x) {
    MatrixXd square = x * x.transpose();
    square.diagonal().array() += 1e-12 * square.trace();
    Eigen::LLT<MatrixXd> factor(square);
    if (factor.info() != Eigen::Success || !square.allFinite())
      throw Error(ErrorKind::numerics,
                  RELUCENT_ENGLISH_MESSAGE("linearization.lights-not-told-apart",
                                           "the photographs do not tell the projector's lights apart"),
                  RELUCENT_ENGLISH_MESSAGE("linearization.check-view-of-picture",
                                           "check that a camera sees the projector's picture sharply"));
    MatrixXd inverse = factor.solve(x);
    rest_ = MatrixXd::Identity(x.cols(), x.cols()) - x.transpose() * inverse;
    lights_ = inverse * products * inverse.transpose();
    slope_ = inverse * products * rest_;
    chiSquare_ = products.cwiseProduct(rest_).sum();
  }

  double chiSquare() const { return chiSquare_; }
  VectorXd descent(const MatrixXd& u) const {
    VectorXd result = VectorXd::Zero(u.cols());
    for (Index q = 0; q < slope_.rows(); ++q)
      result += u.middleRows(q * slope_.cols(), slope_.cols()).transpose() * slope_.row(q).transpose();
    return result;
  }
  MatrixXd curvature(const MatrixXd& u) const {
    Index shots = rest_.rows();
    MatrixXd result = MatrixXd::Zero(u.cols(), u.cols());
    for (Index q = 0; q < lights_.rows(); ++q) {
      MatrixXd mixed = MatrixXd::Zero(shots, u.cols());
      for (Index p = 0; p < lights_.rows(); ++p) mixed += lights_(q, p) * u.middleRows(p * shots, shots);
      result += u.middleRows(q * shots, shots).transpose() * (rest_ * mixed);
    }
    return result;
  }

 private:
  MatrixXd rest_, lights_, slope_;
  double chiSquare_ = 0.0;
};

/// A quadratic a priori term: x^T matrix x - 2 right^T x.
struct Prior {
  MatrixXd matrix;
  VectorXd right;
  double of(const VectorXd& x) const { return x.dot(matrix * x) - 2.0 * right.dot(x); }
};

/// Parameters: the light of the levels between dark and full, channel after channel; the logarithms of the
/// photographs' powers; the white segment.
class Fit {
 public:
  Fit(const std::vector<double>& drives, const std::vector<MosaicShot>& shots, const LightProducts& products,
      const LevelLights& start)
      : shots_(shots),
        levels_(drives.size() - 1),
        products_(whitened(products)),
        scales_(scalesOf(products)),
        x_(VectorXd::Zero(toIndex(3 * levels_ + shots.size() + 1))) {
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t k = 0; k < levels_; ++k) x_[toIndex(c * levels_ + k)] = start[c][k];
    makeSmoothness(drives);
    makeLine();
  }

  ResponseFit run() {
    double flicker = firstFlicker;
    for (int round = 0; round < flickerRounds; ++round) {
      solve(flicker);
      flicker = flickerOf();
    }
    return result(flicker);
  }

 private:
  Index powerAt(std::size_t shot) const { return toIndex(3 * levels_ + shot); }

  /// What the four nearest levels say about each by a cubic, over the square root of drive.
  void makeSmoothness(const std::vector<double>& drives) {
    std::vector<double> place{0.0};
    for (double drive : drives) place.push_back(std::sqrt(drive));
    std::size_t wanted = std::min<std::size_t>(4, place.size() - 1);
    if (wanted < 2) return;
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t k = 1; k + 1 < place.size(); ++k) {
        std::size_t first = std::min(k > 2 ? k - 2 : 0, place.size() - 1 - wanted);
        VectorXd row = VectorXd::Zero(x_.size());
        double constant = 0.0, squares = 0.0;
        auto enter = [&](std::size_t at, double factor) {
          squares += factor * factor;
          if (at > levels_)
            constant -= factor;
          else if (at > 0)
            row[toIndex(c * levels_ + at - 1)] = factor;
        };
        enter(k, -1.0);
        for (std::size_t j = first; j <= first + wanted; ++j) {
          if (j == k) continue;
          double factor = 1.0;
          for (std::size_t i = first; i <= first + wanted; ++i)
            if (i != k && i != j) factor *= (place[k] - place[i]) / (place[j] - place[i]);
          enter(j, factor);
        }
        smoothness_.push_back(row / std::sqrt(squares));
        constants_.push_back(constant / std::sqrt(squares));
      }
  }

  /// Powers less the straight line through the start of time that is closest to them.
  void makeLine() {
    Index count = toIndex(shots_.size());
    time_.resize(count);
    for (std::size_t m = 0; m < shots_.size(); ++m) time_[toIndex(m)] = shots_[m].time - shots_.front().time;
    aboutLine_ = MatrixXd::Identity(count, count);
    if (time_.squaredNorm() > 0.0) aboutLine_ -= time_ * time_.transpose() / time_.squaredNorm();
  }

  Prior prior(double flicker) const {
    Prior prior{MatrixXd::Zero(x_.size(), x_.size()), VectorXd::Zero(x_.size())};
    for (std::size_t i = 0; i < smoothness_.size(); ++i) {
      double rough = smoothness_[i].dot(x_) - constants_[i];
      double weight = 1.0 / (roughness * roughness + rough * rough);
      prior.matrix += weight * smoothness_[i] * smoothness_[i].transpose();
      prior.right += weight * constants_[i] * smoothness_[i];
    }
    Index count = toIndex(shots_.size());
    prior.matrix.block(powerAt(0), powerAt(0), count, count) += aboutLine_ / (flicker * flicker);
    // Without this a measurement of a single instant would not be determined.
    prior.matrix.diagonal().array() += 1e-6;
    return prior;
  }

  double lightOf(const VectorXd& x, std::size_t channel, std::size_t level) const {
    if (level == 0) return 0.0;
    return level > levels_ ? 1.0 : x[toIndex(channel * levels_ + level - 1)];
  }
  double powerOf(const VectorXd& x, std::size_t shot) const {
    return scales_[toIndex(shot)] * std::exp(x[powerAt(shot)]);
  }
  double whiteSegment(const VectorXd& x) const { return x[x.size() - 1]; }

  /// The channel in which a light's group is darkest.
  std::size_t darkest(const VectorXd& x, const MosaicShot& shot, std::size_t light) const {
    std::size_t first = light / 3 * 3, found = 0;
    for (std::size_t c = 1; c < 3; ++c)
      if (lightOf(x, c, shot.level[first + c]) < lightOf(x, found, shot.level[first + found])) found = c;
    return found;
  }

  MatrixXd patternsOf(const VectorXd& x) const {
    MatrixXd patterns(toIndex(mosaicLights), toIndex(shots_.size()));
    for (std::size_t m = 0; m < shots_.size(); ++m)
      for (std::size_t q = 0; q < mosaicLights; ++q) {
        std::size_t least = darkest(x, shots_[m], q);
        double added = whiteSegment(x) * lightOf(x, least, shots_[m].level[q / 3 * 3 + least]);
        patterns(toIndex(q), toIndex(m)) = powerOf(x, m) * (lightOf(x, q % 3, shots_[m].level[q]) + added);
      }
    return patterns;
  }

  MatrixXd derivatives() const {
    MatrixXd u = MatrixXd::Zero(toIndex(mosaicLights * shots_.size()), x_.size());
    const MatrixXd patterns = patternsOf(x_);
    for (std::size_t m = 0; m < shots_.size(); ++m)
      for (std::size_t q = 0; q < mosaicLights; ++q) {
        Index row = toIndex(q * shots_.size() + m);
        double power = powerOf(x_, m);
        u(row, powerAt(m)) = patterns(toIndex(q), toIndex(m));
        auto enter = [&](std::size_t channel, double factor) {
          std::size_t level = shots_[m].level[q / 3 * 3 + channel];
          if (level > 0 && level <= levels_) u(row, toIndex(channel * levels_ + level - 1)) += factor * power;
          return lightOf(x_, channel, level);
        };
        enter(q % 3, 1.0);
        u(row, x_.size() - 1) = power * enter(darkest(x_, shots_[m], q), whiteSegment(x_));
      }
    return u;
  }

  /// Levenberg's and Marquardt's steps.
  void solve(double flicker) {
    double damping = 1e-4;
    for (int step = 0; step < mostSteps; ++step) {
      Prior before = prior(flicker);
      Projection here(products_, patternsOf(x_));
      MatrixXd u = derivatives();
      curvature_ = here.curvature(u) + before.matrix;
      VectorXd descent = here.descent(u) - before.matrix * x_ + before.right;
      double value = here.chiSquare() + before.of(x_), moved = 0.0;
      for (bool better = false; !better; damping *= 10.0) {
        MatrixXd damped = curvature_;
        damped.diagonal() *= 1.0 + damping;
        VectorXd change = damped.ldlt().solve(descent), next = x_ + change;
        double there = Projection(products_, patternsOf(next)).chiSquare() + before.of(next);
        better = there <= value + 1e-9 * std::abs(value);
        moved = change.cwiseAbs().maxCoeff();
        if (better)
          x_ = next;
        else if (damping > 1e8)
          return;
      }
      damping = std::max(1e-12, damping / 100.0);
      if (moved < 1e-7) return;
    }
  }

  VectorXd powers() const { return x_.segment(powerAt(0), toIndex(shots_.size())); }
  MatrixXd covariance() const {
    return curvature_.ldlt().solve(MatrixXd::Identity(curvature_.rows(), curvature_.cols()));
  }

  /// One step of expectation maximisation: of the deviations from the line, what is known of them included.
  double flickerOf() const {
    Index count = toIndex(shots_.size());
    MatrixXd known = covariance().block(powerAt(0), powerAt(0), count, count);
    double squares = (aboutLine_ * powers()).squaredNorm() + (aboutLine_ * known * aboutLine_).trace();
    return std::clamp(std::sqrt(squares / static_cast<double>(std::max<Index>(1, count - 1))), leastFlicker,
                      mostFlicker);
  }

  ResponseFit result(double flicker) const {
    ResponseFit fit;
    VectorXd variances = covariance().diagonal();
    for (std::size_t c = 0; c < 3; ++c) {
      for (std::size_t k = 0; k < levels_; ++k) {
        Index at = toIndex(c * levels_ + k);
        fit.light[c].push_back(x_[at]);
        fit.deviation[c].push_back(std::sqrt(std::max(0.0, variances[at])));
      }
      fit.light[c].push_back(1.0);
      fit.deviation[c].push_back(0.0);
    }
    for (std::size_t m = 0; m < shots_.size(); ++m) fit.power.push_back(powerOf(x_, m) / scales_[toIndex(m)]);
    fit.flicker = flicker;
    fit.whiteSegment = whiteSegment(x_);
    fit.drift = time_.squaredNorm() > 0.0 ? time_.dot(powers()) / time_.squaredNorm() : 0.0;
    return fit;
  }

  const std::vector<MosaicShot>& shots_;
  std::size_t levels_;  // between dark and full
  MatrixXd products_, curvature_, aboutLine_;
  VectorXd scales_, time_, x_;
  std::vector<VectorXd> smoothness_;
  std::vector<double> constants_;
};

}  // namespace

void LightProducts::add(std::span<const double> light, std::span<const double> variance, double weight) {
  for (std::size_t m = 0; m < noise_.size(); ++m) {
    noise_[m] += weight * variance[m];
    for (std::size_t n = 0; n < noise_.size(); ++n)
      products_[m * noise_.size() + n] += weight * light[m] * light[n];
  }
  values_ += 1.0;
}

LightProducts& LightProducts::operator+=(const LightProducts& other) {
  require(other.shots() == shots(), "products of {} and of {} photographs", other.shots(), shots());
  for (std::size_t i = 0; i < products_.size(); ++i) products_[i] += other.products_[i];
  for (std::size_t m = 0; m < noise_.size(); ++m) noise_[m] += other.noise_[m];
  values_ += other.values_;
  return *this;
}

ResponseFit fitResponse(const std::vector<double>& drives, const std::vector<MosaicShot>& shots,
                        const LightProducts& products, const LevelLights& start) {
  require(!drives.empty() && drives.back() == 1.0, "the highest of {} drives is not full", drives.size());
  require(products.shots() == shots.size(), "products of {} for {} photographs", products.shots(),
          shots.size());
  return Fit(drives, shots, products, start).run();
}

RegionDeviation deviationOf(const ResponseFit& fit, const std::vector<MosaicShot>& shots,
                            const LightProducts& region) {
  const MatrixXd products = whitened(region);
  const VectorXd scales = scalesOf(region);
  VectorXd amplitude = VectorXd::Zero(3);
  MatrixXd curvature;
  for (int round = 0; round < 3; ++round) {
    MatrixXd x = MatrixXd::Zero(toIndex(mosaicLights), toIndex(shots.size()));
    MatrixXd u = MatrixXd::Zero(toIndex(mosaicLights * shots.size()), 3);
    for (std::size_t m = 0; m < shots.size(); ++m)
      for (std::size_t q = 0; q < mosaicLights; ++q) {
        std::size_t c = q % 3, level = shots[m].level[q];
        double light = level > 0 ? fit.light[c][level - 1] : 0.0, least = 1.0;
        for (std::size_t other = 0; other < 3; ++other) {
          std::size_t beside = shots[m].level[q / 3 * 3 + other];
          least = std::min(least, beside > 0 ? fit.light[other][beside - 1] : 0.0);
        }
        double bend = light > 0.0 ? -std::exp(1.0) * light * std::log(light) : 0.0;
        double power = scales[toIndex(m)] * fit.power[m];
        x(toIndex(q), toIndex(m)) = power * (light + amplitude[toIndex(c)] * bend + fit.whiteSegment * least);
        u(toIndex(q * shots.size() + m), toIndex(c)) = power * bend;
      }
    Projection here(products, x);
    curvature = here.curvature(u);
    curvature.diagonal().array() += 1.0;  // where a region tells nothing of a channel it deviates by nothing
    amplitude += curvature.ldlt().solve(here.descent(u) - amplitude);
  }
  RegionDeviation result;
  VectorXd variances = curvature.ldlt().solve(MatrixXd::Identity(3, 3)).diagonal();
  for (std::size_t c = 0; c < 3; ++c) {
    result.amplitude[c] = amplitude[toIndex(c)];
    result.deviation[c] = std::sqrt(std::max(0.0, variances[toIndex(c)]));
  }
  return result;
}

}  // namespace relucent::linearization
