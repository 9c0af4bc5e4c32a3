// SPDX-License-Identifier: MIT
#include "relucent/linearization/camera_response.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "relucent/base/error.h"
#include "relucent/hdr/isotonic.h"

namespace relucent::linearization {
namespace {

constexpr int knots = 20;
constexpr double timeDeviation = 0.03;       // a priori, of ln t
constexpr double curvatureDeviation = 0.05;  // a priori, of second differences of ln response
constexpr double slopeDeviation = 1.0;       // a priori, of d ln response / d ln signal around 1
constexpr double exponentLimit = 0.04;
constexpr double shapeLimit = 0.03;
constexpr std::size_t pixelsPerChannel = 4000;

/// Unknowns: ln response at the knots of three channels, then one time error an exposure.
class Estimate {
 public:
  Estimate(const rig::Shot& bracket, std::size_t camera, double saturation) : saturation_(saturation) {
    for (const std::vector<rig::RawFrame>& exposure : bracket.frames) frames_.push_back(&exposure.at(camera));
    int bits = frames_.front()->bits;
    step_ = bits > 0 ? 1.0 / (std::ldexp(1.0, bits) - 1.0) : 0.0;
    // Below some 6 codes the logarithm of a rounded signal is biased.
    darkest_ = std::log(std::max(0.02, 6.0 * step_));
    spacing_ = -darkest_ / (knots - 1);
    int unknowns = 3 * knots + static_cast<int>(frames_.size());
    normal_ = Eigen::MatrixXd::Zero(unknowns, unknowns);
    right_ = Eigen::VectorXd::Zero(unknowns);
    samples_ = Eigen::VectorXd::Zero(3 * knots);
    seen_ = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(frames_.size()));
  }

  void solve() {
    addPriors();
    for (std::size_t c = 0; c < 3; ++c) addPixels(c);
    addGauge();
    solution_ = normal_.ldlt().solve(right_);
  }

  /// Whether signals were seen about a knot. Elsewhere the curve is a continuation that tells nothing.
  bool supported(std::size_t channel, int index) const {
    constexpr double fewest = 10.0;
    return samples_[static_cast<int>(channel) * knots + index] >= fewest;
  }
  double knot(int index) const { return darkest_ + spacing_ * index; }
  double logResponse(std::size_t channel, int index) const {
    return solution_[static_cast<int>(channel) * knots + index];
  }

 private:
  /// An equation's few coefficients.
  struct Row {
    std::array<int, 3> unknown{};
    std::array<double, 3> factor{};
    double value = 0.0;
    double weight = 0.0;
  };

  void addPriors() {
    for (int c = 0; c < 3; ++c) {
      int first = c * knots;
      add({{first + knots - 1, first, first}, {1.0, 0.0, 0.0}, 0.0, 1e8});
      for (int i = 1; i + 1 < knots; ++i)
        add({{first + i - 1, first + i, first + i + 1},
             {1.0, -2.0, 1.0},
             0.0,
             1.0 / (curvatureDeviation * curvatureDeviation)});
      for (int i = 1; i < knots; ++i)
        add({{first + i - 1, first + i, first},
             {-1.0, 1.0, 0.0},
             spacing_,
             1.0 / (slopeDeviation * slopeDeviation)});
    }
    for (int k = 0; k < static_cast<int>(frames_.size()); ++k)
      add({{3 * knots + k, 0, 0}, {1.0, 0.0, 0.0}, 0.0, 1.0 / (timeDeviation * timeDeviation)});
  }

  /// No power law among the time errors: sum_k n_k d_k (ln t_k - mean) = 0, n_k the values seen at exposure
  /// k. It would fit as well as an exponent of the response, and noise, which flattens what is fitted over
  /// it, would decide between the two. Exposures that show little must not count: their errors are free to
  /// balance a power law among the others.
  void addGauge() {
    auto count = static_cast<Eigen::Index>(frames_.size());
    Eigen::VectorXd logTime(count);
    for (Eigen::Index k = 0; k < count; ++k)
      logTime[k] = std::log(frames_[static_cast<std::size_t>(k)]->seconds);
    if (seen_.sum() <= 0.0) return;
    logTime.array() -= seen_.dot(logTime) / seen_.sum();
    Eigen::VectorXd gauge = (seen_ / seen_.maxCoeff()).cwiseProduct(logTime);
    normal_.bottomRightCorner(count, count) += 1e12 * gauge * gauge.transpose();
  }

  void addPixels(std::size_t channel) {
    std::size_t pixels = frames_.front()->signal.pixels();
    std::size_t stride = pixels / pixelsPerChannel + 1;
    std::vector<Row> rows;
    for (std::size_t pixel = 0; pixel < pixels; pixel += stride) {
      rows.clear();
      for (std::size_t k = 0; k < frames_.size(); ++k) {
        double signal = static_cast<double>(frames_[k]->signal.pixel(pixel)[channel]);
        if (signal >= 0.98 * saturation_ || signal <= 0.0 || tooDark(pixel, channel, k)) continue;
        rows.push_back(equation(channel, k, signal));
      }
      if (rows.size() < 2) continue;
      addEliminated(rows);
      for (const Row& row : rows) {
        seen_[row.unknown[2] - 3 * knots] += 1.0;
        for (std::size_t i = 0; i < 2; ++i) samples_[row.unknown[i]] += row.factor[i];
      }
    }
  }

  /// Judged by the next longer exposure where there is one: sorting values out by their own noise would leave
  /// those that it had made brighter.
  bool tooDark(std::size_t pixel, std::size_t channel, std::size_t exposure) const {
    std::size_t judge = exposure > 0 ? exposure - 1 : exposure;
    double signal = static_cast<double>(frames_[judge]->signal.pixel(pixel)[channel]);
    return signal * frames_[exposure]->seconds / frames_[judge]->seconds < std::exp(darkest_);
  }

  Row equation(std::size_t channel, std::size_t exposure, double signal) const {
    double place = (std::log(signal) - darkest_) / spacing_;
    int index = std::clamp(static_cast<int>(place), 0, knots - 2);
    double share = place - index;
    int first = static_cast<int>(channel) * knots + index;
    // Noise in ln z before it has been measured: a generous read noise, and 1 % for all that is proportional.
    double relative = std::hypot(std::max(2e-3, step_) / signal, 0.01);
    return {{first, first + 1, 3 * knots + static_cast<int>(exposure)},
            {1.0 - share, share, -1.0},
            std::log(frames_[exposure]->seconds),
            1.0 / (relative * relative)};
  }

  void add(const Row& row) {
    for (std::size_t i = 0; i < 3; ++i) {
      right_[row.unknown[i]] += row.weight * row.factor[i] * row.value;
      for (std::size_t j = 0; j < 3; ++j)
        normal_(row.unknown[i], row.unknown[j]) += row.weight * row.factor[i] * row.factor[j];
    }
  }

  /// The equations of one pixel, less their weighted mean: that is what solving for its light leaves.
  void addEliminated(const std::vector<Row>& rows) {
    double weights = 0.0, value = 0.0;
    for (const Row& row : rows) {
      add(row);
      weights += row.weight;
      value += row.weight * row.value;
    }
    for (const Row& row : rows)
      for (std::size_t i = 0; i < 3; ++i) {
        double left = row.weight * row.factor[i] / weights;
        right_[row.unknown[i]] -= left * value;
        for (const Row& other : rows)
          for (std::size_t j = 0; j < 3; ++j)
            normal_(row.unknown[i], other.unknown[j]) -= left * other.weight * other.factor[j];
      }
  }

  std::vector<const rig::RawFrame*> frames_;
  double saturation_;
  double step_ = 0.0, darkest_ = 0.0, spacing_ = 0.0;
  Eigen::MatrixXd normal_;
  Eigen::VectorXd right_, solution_, seen_, samples_;
};

struct PowerLaw {
  double exponent = 1.0;
  double deviation = 0.0;
};

/// The power law closest to a channel's curve between 5 and 95 % of full signal.
PowerLaw closestPowerLaw(const Estimate& estimate, std::size_t channel) {
  double n = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
  auto inside = [&](int i) {
    return estimate.knot(i) > std::log(0.05) && estimate.knot(i) < std::log(0.95) &&
           estimate.supported(channel, i);
  };
  for (int i = 0; i < knots; ++i) {
    if (!inside(i)) continue;
    double atX = estimate.knot(i), atY = estimate.logResponse(channel, i);
    n += 1.0, x += atX, y += atY, xx += atX * atX, xy += atX * atY;
  }
  if (n < 2.0) return {};  // nothing speaks against a straight line
  PowerLaw law{(n * xy - x * y) / (n * xx - x * x), 0.0};
  double offset = (y - law.exponent * x) / n;
  for (int i = 0; i < knots; ++i)
    if (inside(i))
      law.deviation = std::max(law.deviation, std::abs(estimate.logResponse(channel, i) - offset -
                                                       law.exponent * estimate.knot(i)));
  return law;
}

/// What two exposures of the same light say of each other.
struct Comparison {
  double ratio = 1.0;      // of their signals
  double bend = 0.0;       // logarithm of the brighter half's ratio over the darker one's
  double times = 1.0;      // the ratio that it should be
  std::size_t values = 0;  // compared
};

Comparison compared(const rig::RawFrame& longer, const rig::RawFrame& shorter, double saturation) {
  double step = longer.bits > 0 ? 1.0 / (std::ldexp(1.0, longer.bits) - 1.0) : 0.0;
  double times = longer.seconds / shorter.seconds, darkest = std::max(0.02, 6.0 * step);
  std::vector<std::pair<double, double>> pairs;
  for (std::size_t at = 0; at < longer.signal.data().size(); ++at) {
    double bright = static_cast<double>(longer.signal.data()[at]);
    // The expected signal decides what is dark: that of the shorter exposure would favour what noise raised.
    if (bright < 0.9 * saturation && bright > darkest * times)
      pairs.emplace_back(bright, static_cast<double>(shorter.signal.data()[at]));
  }
  Comparison result{1.0, 0.0, times, pairs.size()};
  if (pairs.size() < 2) return result;
  auto middle = pairs.begin() + static_cast<std::ptrdiff_t>(pairs.size() / 2);
  std::nth_element(pairs.begin(), middle, pairs.end());
  auto ratioOf = [](auto first, auto last) {
    double bright = 0.0, dark = 0.0;
    for (; first != last; ++first) bright += first->first, dark += first->second;
    return bright / std::max(dark, 1e-9);
  };
  result.ratio = ratioOf(pairs.begin(), pairs.end());
  result.bend = std::log(ratioOf(middle, pairs.end()) / ratioOf(pairs.begin(), middle));
  return result;
}

/// Below the darkest knot the curve goes on as the power law that it has there.
hdr::ResponseCurve curveOf(const Estimate& estimate, std::size_t channel) {
  double exponent = (estimate.logResponse(channel, 2) - estimate.logResponse(channel, 0)) /
                    (estimate.knot(2) - estimate.knot(0));
  exponent = std::max(exponent, 0.1);
  std::vector<double> x{0.0}, y{0.0};
  for (double share : {0.1, 0.2, 0.35, 0.5, 0.7}) {
    x.push_back(share * std::exp(estimate.knot(0)));
    y.push_back(std::pow(share, exponent) * std::exp(estimate.logResponse(channel, 0)));
  }
  for (int i = 0; i < knots; ++i) {
    x.push_back(i + 1 < knots ? std::exp(estimate.knot(i)) : 1.0);
    y.push_back(std::exp(estimate.logResponse(channel, i)));
  }
  return hdr::curveFromRamp(x, y, std::vector<double>(x.size(), 1.0));
}

}  // namespace

std::vector<double> responseBracket(const rig::ExposureRange& range, const std::vector<double>& exposures) {
  require(!exposures.empty(), "a response cannot be told without exposures");
  double least = std::max(exposures.back() / 4.0, range.shortest);
  std::vector<double> seconds;
  for (double time = std::min(exposures.front(), range.longest); time >= 0.999 * least;
       time /= seconds.size() % 2 == 1 ? 2.0 : 1.5)
    seconds.push_back(time);
  return seconds;
}

bool looksLinear(const rig::Shot& bracket, std::size_t camera, double saturation) {
  constexpr std::size_t fewestValues = 100;
  double products = 0.0, squares = 0.0;
  for (std::size_t k = 0; k + 1 < bracket.frames.size(); ++k) {
    Comparison pair = compared(bracket.frames[k][camera], bracket.frames[k + 1][camera], saturation);
    if (pair.values < fewestValues || pair.times < 1.2) continue;
    if (std::abs(pair.bend) > shapeLimit) return false;
    products += std::log(pair.ratio) * std::log(pair.times);
    squares += std::log(pair.times) * std::log(pair.times);
  }
  return squares == 0.0 || std::abs(products / squares - 1.0) <= exponentLimit;
}

CameraResponse cameraResponse(const rig::Shot& bracket, std::size_t camera, double saturation) {
  require(!bracket.frames.empty(), "a bracket without exposures tells no response");
  CameraResponse response;
  if (bracket.frames.size() < 2) return response;
  Estimate estimate(bracket, camera, saturation);
  estimate.solve();
  for (std::size_t c = 0; c < 3; ++c) {
    PowerLaw law = closestPowerLaw(estimate, c);
    if (std::abs(law.exponent - 1.0) > std::abs(response.exponent - 1.0)) response.exponent = law.exponent;
    response.deviation = std::max(response.deviation, law.deviation);
  }
  bool linear = std::abs(response.exponent - 1.0) <= exponentLimit && response.deviation <= shapeLimit;
  if (!linear)
    for (std::size_t c = 0; c < 3; ++c) response.curves[c] = curveOf(estimate, c);
  return response;
}

}  // namespace relucent::linearization
