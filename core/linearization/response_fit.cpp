// SPDX-License-Identifier: MIT
#include "relucent/linearization/response_fit.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/SparseCore>
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
// Of a step, to take another: of white, and of chi^2 with the a priori terms, where a standard deviation
// is 1.
constexpr double leastMove = 1e-7, leastImprovement = 1e-5;

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

/// Derivatives of the rows of X that some consecutive lights are, one after the other, by parameters: shots x
/// parameters each. An element of X depends on four parameters at most.
using Derivatives = std::vector<Eigen::SparseMatrix<double>>;

/// chi^2 at X and, with U = dX / d parameters (a row for each of X's elements, light after light), its
/// gradient and the approximation of its curvature that Kaufman gives:
///   Q = I - X^+ X,  gradient/2 = -U^T vec(X^+^T C Q),  curvature/2 = U^T (X^+^T C X^+ (x) Q) U
/// Given are the rows of U for some consecutive lights from `first` on, the others' being zero.
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
  VectorXd descent(const Derivatives& u, std::size_t first) const {
    VectorXd result = VectorXd::Zero(u.front().cols());
    for (std::size_t q = 0; q < u.size(); ++q)
      result += u[q].transpose() * slope_.row(toIndex(first + q)).transpose();
    return result;
  }
  /// Q U, light after light.
  std::vector<MatrixXd> rest(const Derivatives& u) const {
    std::vector<MatrixXd> result;
    for (const Eigen::SparseMatrix<double>& light : u) result.push_back(rest_ * light);
    return result;
  }
  /// A row for each parameter of `u`, a column for each of those whose rest() is `other`.
  MatrixXd curvature(const Derivatives& u, std::size_t first, const std::vector<MatrixXd>& other,
                     std::size_t firstOther) const {
    MatrixXd result = MatrixXd::Zero(u.front().cols(), other.front().cols());
    for (std::size_t q = 0; q < u.size(); ++q) {
      MatrixXd mixed = MatrixXd::Zero(other.front().rows(), other.front().cols());
      for (std::size_t p = 0; p < other.size(); ++p)
        mixed += lights_(toIndex(first + q), toIndex(firstOther + p)) * other[p];
      result += u[q].transpose() * mixed;
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

/// What is unknown of one projector: the light of the levels between dark and full, channel after channel;
/// the logarithms of the lamp's power in the photographs that it lights; the white segment.
class Unknowns {
 public:
  Unknowns(std::size_t projector, const std::vector<double>& drives, const std::vector<MosaicShot>& shots,
           const VectorXd& scales, const LevelLights& start)
      : projector_(projector),
        shots_(shots),
        scales_(scales),
        levels_(drives.size() - 1),
        lit_(shots.size(), false) {
    for (std::size_t m = 0; m < shots.size(); ++m) {
      lit_[m] = std::ranges::any_of(levelsIn(m), [](std::size_t level) { return level > 0; });
      powerAt_.push_back(toIndex(3 * levels_ + litShots_.size()));
      if (lit_[m]) litShots_.push_back(m);
    }
    x_ = VectorXd::Zero(toIndex(3 * levels_ + litShots_.size() + 1));
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t k = 0; k < levels_; ++k) x_[toIndex(c * levels_ + k)] = start[c][k];
    makeSmoothness(drives);
    makeLine();
  }

  const VectorXd& values() const { return x_; }
  void set(const VectorXd& values) { x_ = values; }

  Prior prior(double flicker) const {
    Prior prior{MatrixXd::Zero(x_.size(), x_.size()), VectorXd::Zero(x_.size())};
    for (std::size_t i = 0; i < smoothness_.size(); ++i) {
      double rough = smoothness_[i].dot(x_) - constants_[i];
      double weight = 1.0 / (roughness * roughness + rough * rough);
      prior.matrix += weight * smoothness_[i] * smoothness_[i].transpose();
      prior.right += weight * constants_[i] * smoothness_[i];
    }
    prior.matrix.block(firstPower(), firstPower(), powerCount(), powerCount()) +=
        aboutLine_ / (flicker * flicker);
    // Without this a measurement of a single instant would not be determined.
    prior.matrix.diagonal().array() += 1e-6;
    return prior;
  }

  /// This projector's rows of X for the unknowns `x`.
  MatrixXd patterns(const VectorXd& x) const {
    MatrixXd patterns = MatrixXd::Zero(toIndex(mosaicLights), toIndex(shots_.size()));
    for (std::size_t m : litShots_)
      for (std::size_t q = 0; q < mosaicLights; ++q) {
        std::size_t least = darkest(x, levelsIn(m), q);
        double added = whiteSegment(x) * lightOf(x, least, levelsIn(m)[q / 3 * 3 + least]);
        patterns(toIndex(q), toIndex(m)) = powerOf(x, m) * (lightOf(x, q % 3, levelsIn(m)[q]) + added);
      }
    return patterns;
  }

  Derivatives derivatives() const {
    const MatrixXd here = patterns(x_);
    Derivatives u;
    for (std::size_t q = 0; q < mosaicLights; ++q) {
      std::vector<Eigen::Triplet<double>> entries;
      for (std::size_t m : litShots_) {
        const Index row = toIndex(m);
        double power = powerOf(x_, m);
        entries.emplace_back(row, powerAt_[m], here(toIndex(q), row));
        auto enter = [&](std::size_t channel, double factor) {
          std::size_t level = levelsIn(m)[q / 3 * 3 + channel];
          if (level > 0 && level <= levels_)
            entries.emplace_back(row, toIndex(channel * levels_ + level - 1), factor * power);
          return lightOf(x_, channel, level);
        };
        enter(q % 3, 1.0);
        const double least = enter(darkest(x_, levelsIn(m), q), whiteSegment(x_));
        entries.emplace_back(row, x_.size() - 1, power * least);
      }
      // Where a light is the darkest of its group, two entries add up.
      u.emplace_back(toIndex(shots_.size()), x_.size()).setFromTriplets(entries.begin(), entries.end());
    }
    return u;
  }

  /// One step of expectation maximisation: of the deviations from the line, what is known of them included.
  double flicker(const MatrixXd& covariance) const {
    MatrixXd known = covariance.block(firstPower(), firstPower(), powerCount(), powerCount());
    double squares = (aboutLine_ * powers()).squaredNorm() + (aboutLine_ * known * aboutLine_).trace();
    return std::clamp(std::sqrt(squares / static_cast<double>(std::max<Index>(1, powerCount() - 1))),
                      leastFlicker, mostFlicker);
  }

  /// `alone`: by how much each unknown would move without what is known a priori.
  ResponseFit result(const VectorXd& variances, const VectorXd& alone, double flicker) const {
    ResponseFit fit;
    for (std::size_t c = 0; c < 3; ++c) {
      for (std::size_t k = 0; k < levels_; ++k) {
        Index at = toIndex(c * levels_ + k);
        fit.light[c].push_back(x_[at]);
        fit.deviation[c].push_back(std::sqrt(std::max(0.0, variances[at])));
        fit.residual[c].push_back(alone[at]);
      }
      fit.light[c].push_back(1.0);
      fit.deviation[c].push_back(0.0);
      fit.residual[c].push_back(0.0);
    }
    for (std::size_t m = 0; m < shots_.size(); ++m)
      fit.power.push_back(lit_[m] ? powerOf(x_, m) / scales_[toIndex(m)] : 1.0);
    fit.flicker = flicker;
    fit.whiteSegment = whiteSegment(x_);
    fit.drift = time_.squaredNorm() > 0.0 ? time_.dot(powers()) / time_.squaredNorm() : 0.0;
    return fit;
  }

 private:
  const MosaicLevels& levelsIn(std::size_t shot) const { return shots_[shot].level[projector_]; }
  Index firstPower() const { return toIndex(3 * levels_); }
  Index powerCount() const { return toIndex(litShots_.size()); }
  VectorXd powers() const { return x_.segment(firstPower(), powerCount()); }

  double lightOf(const VectorXd& x, std::size_t channel, std::size_t level) const {
    if (level == 0) return 0.0;
    return level > levels_ ? 1.0 : x[toIndex(channel * levels_ + level - 1)];
  }
  double powerOf(const VectorXd& x, std::size_t shot) const {
    return scales_[toIndex(shot)] * std::exp(x[powerAt_[shot]]);
  }
  double whiteSegment(const VectorXd& x) const { return x[x.size() - 1]; }

  /// The channel in which a light's group is darkest.
  std::size_t darkest(const VectorXd& x, const MosaicLevels& levels, std::size_t light) const {
    std::size_t first = light / 3 * 3, found = 0;
    for (std::size_t c = 1; c < 3; ++c)
      if (lightOf(x, c, levels[first + c]) < lightOf(x, found, levels[first + found])) found = c;
    return found;
  }

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
    time_.resize(powerCount());
    for (std::size_t i = 0; i < litShots_.size(); ++i)
      time_[toIndex(i)] = shots_[litShots_[i]].time - shots_[litShots_.front()].time;
    aboutLine_ = MatrixXd::Identity(powerCount(), powerCount());
    if (time_.squaredNorm() > 0.0) aboutLine_ -= time_ * time_.transpose() / time_.squaredNorm();
  }

  std::size_t projector_;
  const std::vector<MosaicShot>& shots_;
  const VectorXd& scales_;
  std::size_t levels_;  // between dark and full
  std::vector<bool> lit_;
  std::vector<std::size_t> litShots_;
  std::vector<Index> powerAt_;
  VectorXd x_, time_;
  MatrixXd aboutLine_;
  std::vector<VectorXd> smoothness_;
  std::vector<double> constants_;
};

/// All projectors' unknowns, one projector's after the other's.
class Fit {
 public:
  Fit(const std::vector<std::vector<double>>& drives, const std::vector<MosaicShot>& shots,
      const LightProducts& products, const std::vector<LevelLights>& start)
      : shots_(toIndex(shots.size())), products_(whitened(products)), scales_(scalesOf(products)) {
    for (std::size_t p = 0; p < drives.size(); ++p) {
      first_.push_back(size_);
      projectors_.emplace_back(p, drives[p], shots, scales_, start[p]);
      size_ += projectors_.back().values().size();
    }
  }
  // The projectors refer to the scales.
  Fit(const Fit&) = delete;
  Fit& operator=(const Fit&) = delete;

  std::vector<ResponseFit> run(Progress& progress) {
    std::vector<double> flicker(projectors_.size(), firstFlicker);
    for (int round = 0; round < flickerRounds; ++round) {
      solve(flicker, progress);
      const MatrixXd known = covariance();
      for (std::size_t p = 0; p < projectors_.size(); ++p)
        flicker[p] = projectors_[p].flicker(known.block(first_[p], first_[p], count(p), count(p)));
      progress.report((round + 1.0) / flickerRounds);
    }
    const VectorXd variances = covariance().diagonal(), alone = alonePulls();
    std::vector<ResponseFit> result;
    for (std::size_t p = 0; p < projectors_.size(); ++p)
      result.push_back(projectors_[p].result(variances.segment(first_[p], count(p)),
                                             alone.segment(first_[p], count(p)), flicker[p]));
    return result;
  }

 private:
  Index count(std::size_t projector) const { return projectors_[projector].values().size(); }

  VectorXd values() const {
    VectorXd x(size_);
    for (std::size_t p = 0; p < projectors_.size(); ++p)
      x.segment(first_[p], count(p)) = projectors_[p].values();
    return x;
  }
  void set(const VectorXd& x) {
    for (std::size_t p = 0; p < projectors_.size(); ++p) projectors_[p].set(x.segment(first_[p], count(p)));
  }

  MatrixXd patternsOf(const VectorXd& x) const {
    MatrixXd patterns(toIndex(projectors_.size() * mosaicLights), shots_);
    for (std::size_t p = 0; p < projectors_.size(); ++p)
      patterns.middleRows(toIndex(p * mosaicLights), toIndex(mosaicLights)) =
          projectors_[p].patterns(x.segment(first_[p], count(p)));
    return patterns;
  }

  Prior prior(const std::vector<double>& flicker) const {
    Prior prior{MatrixXd::Zero(size_, size_), VectorXd::Zero(size_)};
    for (std::size_t p = 0; p < projectors_.size(); ++p) {
      const Prior own = projectors_[p].prior(flicker[p]);
      prior.matrix.block(first_[p], first_[p], count(p), count(p)) = own.matrix;
      prior.right.segment(first_[p], count(p)) = own.right;
    }
    return prior;
  }

  /// Of chi^2 alone. A projector's unknowns change its own lights only.
  void linearize(const Projection& here, MatrixXd& curvature, VectorXd& descent) const {
    std::vector<Derivatives> derivatives;
    std::vector<std::vector<MatrixXd>> rest;
    for (const Unknowns& projector : projectors_) {
      derivatives.push_back(projector.derivatives());
      rest.push_back(here.rest(derivatives.back()));
    }
    curvature.resize(size_, size_);
    descent.resize(size_);
    for (std::size_t p = 0; p < projectors_.size(); ++p) {
      descent.segment(first_[p], count(p)) = here.descent(derivatives[p], p * mosaicLights);
      for (std::size_t other = p; other < projectors_.size(); ++other) {
        const MatrixXd block =
            here.curvature(derivatives[p], p * mosaicLights, rest[other], other * mosaicLights);
        curvature.block(first_[p], first_[other], count(p), count(other)) = block;
        if (other != p) curvature.block(first_[other], first_[p], count(other), count(p)) = block.transpose();
      }
    }
  }

  /// Where the photographs alone would move each unknown, the others as they are.
  VectorXd alonePulls() const {
    MatrixXd curvature;
    VectorXd descent;
    linearize(Projection(products_, patternsOf(values())), curvature, descent);
    const VectorXd most = curvature.diagonal();
    const double least = 1e-9 * std::max(most.maxCoeff(), 1e-300);
    VectorXd pulls = VectorXd::Zero(size_);
    for (Index i = 0; i < size_; ++i)
      if (most[i] > least) pulls[i] = descent[i] / most[i];
    return pulls;
  }

  /// Levenberg's and Marquardt's steps.
  void solve(const std::vector<double>& flicker, const Progress& progress) {
    double damping = 1e-4;
    for (int step = 0; step < mostSteps; ++step) {
      progress.checkpoint();
      const VectorXd x = values();
      const Prior before = prior(flicker);
      const Projection here(products_, patternsOf(x));
      VectorXd descent;
      linearize(here, curvature_, descent);
      curvature_ += before.matrix;
      descent = descent - before.matrix * x + before.right;
      double value = here.chiSquare() + before.of(x), moved = 0.0, gain = 0.0;
      for (bool better = false; !better; damping *= 10.0) {
        MatrixXd damped = curvature_;
        damped.diagonal() *= 1.0 + damping;
        VectorXd change = damped.ldlt().solve(descent), next = x + change;
        double there = Projection(products_, patternsOf(next)).chiSquare() + before.of(next);
        better = there <= value + 1e-9 * std::abs(value);
        moved = change.cwiseAbs().maxCoeff();
        gain = value - there;
        if (better)
          set(next);
        else if (damping > 1e8)
          return;
      }
      damping = std::max(1e-12, damping / 100.0);
      // Where two channels are equally dark, steps may go back and forth between them.
      if (moved < leastMove || gain < leastImprovement) return;
    }
  }

  MatrixXd covariance() const {
    return curvature_.ldlt().solve(MatrixXd::Identity(curvature_.rows(), curvature_.cols()));
  }

  Index shots_, size_ = 0;
  MatrixXd products_, curvature_;
  VectorXd scales_;
  std::vector<Unknowns> projectors_;
  std::vector<Index> first_;  // of each projector's unknowns
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

std::vector<LevelLights> usualResponses(const std::vector<std::vector<double>>& drives) {
  std::vector<LevelLights> responses(drives.size());
  for (std::size_t p = 0; p < drives.size(); ++p)
    for (std::vector<double>& channel : responses[p])
      for (double drive : drives[p]) channel.push_back(std::pow(drive, 2.2));
  return responses;
}

std::vector<ResponseFit> fitResponses(const std::vector<std::vector<double>>& drives,
                                      const std::vector<MosaicShot>& shots, const LightProducts& products,
                                      const std::vector<LevelLights>& start, Progress& progress) {
  require(drives.size() == start.size(), "{} projectors' drives and {} responses", drives.size(),
          start.size());
  for (const std::vector<double>& own : drives)
    require(!own.empty() && own.back() == 1.0, "the highest of {} drives is not full", own.size());
  for (const MosaicShot& shot : shots)
    require(shot.level.size() == drives.size(), "a photograph of {} projectors of {}", shot.level.size(),
            drives.size());
  require(products.shots() == shots.size(), "products of {} for {} photographs", products.shots(),
          shots.size());
  return Fit(drives, shots, products, start).run(progress);
}

std::vector<RegionDeviation> deviationsOf(const std::vector<ResponseFit>& fits,
                                          const std::vector<MosaicShot>& shots, const LightProducts& region) {
  const MatrixXd products = whitened(region);
  const VectorXd scales = scalesOf(region);
  const std::size_t lights = fits.size() * mosaicLights;
  const Index unknown = toIndex(3 * fits.size());
  VectorXd amplitude = VectorXd::Zero(unknown);
  MatrixXd curvature;
  for (int round = 0; round < 3; ++round) {
    MatrixXd x = MatrixXd::Zero(toIndex(lights), toIndex(shots.size()));
    Derivatives u(lights, Eigen::SparseMatrix<double>(toIndex(shots.size()), unknown));
    for (std::size_t m = 0; m < shots.size(); ++m)
      for (std::size_t row = 0; row < lights; ++row) {
        const std::size_t p = row / mosaicLights, q = row % mosaicLights, c = q % 3;
        const ResponseFit& fit = fits[p];
        const MosaicLevels& levels = shots[m].level[p];
        double light = levels[q] > 0 ? fit.light[c][levels[q] - 1] : 0.0, least = 1.0;
        for (std::size_t other = 0; other < 3; ++other) {
          std::size_t beside = levels[q / 3 * 3 + other];
          least = std::min(least, beside > 0 ? fit.light[other][beside - 1] : 0.0);
        }
        double bend = light > 0.0 ? -std::exp(1.0) * light * std::log(light) : 0.0;
        double power = scales[toIndex(m)] * fit.power[m];
        const Index at = toIndex(3 * p + c);
        x(toIndex(row), toIndex(m)) = power * (light + amplitude[at] * bend + fit.whiteSegment * least);
        u[row].insert(toIndex(m), at) = power * bend;
      }
    Projection here(products, x);
    curvature = here.curvature(u, 0, here.rest(u), 0);
    curvature.diagonal().array() += 1.0;  // where a region tells nothing of a channel it deviates by nothing
    amplitude += curvature.ldlt().solve(here.descent(u, 0) - amplitude);
  }
  std::vector<RegionDeviation> result(fits.size());
  const VectorXd variances = curvature.ldlt().solve(MatrixXd::Identity(unknown, unknown)).diagonal();
  for (Index at = 0; at < unknown; ++at) {
    RegionDeviation& own = result[static_cast<std::size_t>(at / 3)];
    own.amplitude[static_cast<std::size_t>(at % 3)] = amplitude[at];
    own.deviation[static_cast<std::size_t>(at % 3)] = std::sqrt(std::max(0.0, variances[at]));
  }
  return result;
}

}  // namespace relucent::linearization
