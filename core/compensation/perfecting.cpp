// SPDX-License-Identifier: MIT
#include "relucent/compensation/perfecting.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "relucent/base/require.h"
#include "relucent/compensation/stacks.h"

namespace relucent::compensation {
namespace {

/// Values that are about as bright as each other, by the octave: what T is wrong by goes with the light.
constexpr int octaves = 12;       // below the brightest; darker ones are with the last
constexpr double fewest = 100.0;  // of which a mean is told; of fewer that of all, as a share of the light

int octaveOf(double light, double brightest) {
  if (!(light > 0.0)) return octaves - 1;
  return std::clamp(static_cast<int>(std::floor(std::log2(brightest / light))), 0, octaves - 1);
}

double squared(double value) {
  return value * value;
}

}  // namespace

Unexplained::Unexplained(const MeasuredVenue& venue)
    : venue_(venue), value_(venue.black.size(), 0.0f), uncertainty_(venue.black.size(), 0.0f) {}

void Unexplained::begin(const hdr::HdrFrame& light, const CameraStack& predicted) {
  const double brightest = *std::max_element(predicted.begin(), predicted.end());
  struct Excess {
    double sum = 0.0, square = 0.0, count = 0.0;
  };
  std::array<Excess, octaves> excesses;
  double apart = 0.0, whole = 0.0;
  for (std::size_t i = 0; i < predicted.size(); ++i) {
    if (light.valid[i] == 0 || venue_.usable[i / 3] == 0) continue;
    const double excess = squared(static_cast<double>(light.radiance[i]) - predicted[i]) - light.variance[i];
    Excess& among = excesses[static_cast<std::size_t>(octaveOf(predicted[i], brightest))];
    among.sum += excess;
    among.square += squared(excess);
    among.count += 1.0;
    apart += excess;
    whole += squared(predicted[i]);
  }
  relative_ = whole > 0.0 ? std::sqrt(std::max(0.0, apart) / whole) : 0.0;
  std::array<double, octaves> q{};
  for (std::size_t octave = 0; octave < octaves; ++octave) {
    const Excess& among = excesses[octave];
    if (among.count < fewest) continue;
    const double mean = among.sum / among.count;
    const double scatter = std::sqrt(std::max(0.0, among.square / among.count - squared(mean)));
    q[octave] = std::max(0.0, mean - scatter / std::sqrt(among.count));
  }
  for (std::size_t i = 0; i < predicted.size(); ++i) {
    const auto octave = static_cast<std::size_t>(octaveOf(predicted[i], brightest));
    uncertainty_[i] =
        static_cast<float>(excesses[octave].count < fewest ? squared(relative_ * predicted[i]) : q[octave]);
  }
}

void Unexplained::learn(const hdr::HdrFrame& light, const CameraStack& predicted) {
  require(light.radiance.size() == value_.size() && predicted.size() == value_.size(),
          "a photograph of {} values for {}", light.radiance.size(), value_.size());
  const bool first = predicted_.empty();
  if (first) begin(light, predicted);
  const double t2 = squared(relative_);
  parallelFor(0, value_.size(), 4096, [&](std::size_t i) {
    const double is = predicted[i];
    double q = uncertainty_[i];
    if (!first) q += t2 * squared(is - predicted_[i]);
    if (light.valid[i] != 0 && q > 0.0) {
      const double k = q / (q + light.variance[i]);
      const double d = static_cast<double>(light.radiance[i]) - is;
      value_[i] += static_cast<float>(k * (d - value_[i]));
      q *= 1.0 - k;
    }
    uncertainty_[i] = static_cast<float>(q);
  });
  predicted_ = predicted;
}

WeighedError weighedError(const hdr::HdrFrame& light, const Target& target) {
  const std::size_t values = target.asked.size();
  require(light.radiance.size() == values, "a photograph of {} values for {}", light.radiance.size(), values);
  const auto sum = [&](const auto& term) {
    return sumOf(values, [&](std::size_t i) {
      const double weight = light.valid[i] != 0 ? target.weight[i / 3] : 0.0;
      return weight > 0.0 ? term(i, weight) : 0.0;
    });
  };
  const auto apart = [&](std::size_t i) { return static_cast<double>(light.radiance[i]) - target.asked[i]; };
  const double whole = sum([&](std::size_t i, double w) { return w * squared(target.asked[i]); });
  if (!(whole > 0.0)) return {};
  const double error =
      sum([&](std::size_t i, double w) { return w * (squared(apart(i)) - light.variance[i]); });
  // Of a normal d with variance v: var(d^2) = 4 mean^2 v + 2 v^2, and d^2 - v estimates mean^2.
  const double variance = sum([&](std::size_t i, double w) {
    const double v = light.variance[i];
    return w * w * (4.0 * std::max(0.0, squared(apart(i)) - v) * v + 2.0 * v * v);
  });
  return {error / whole, std::sqrt(variance) / whole};
}

Compensation solvedAgain(const Compensator& compensator, const Target& target, const CameraStack& unexplained,
                         Compensation p, int rounds, Progress& progress) {
  const MeasuredVenue& venue = compensator.venue();
  Target corrected = target;
  const CameraStack& flood = floodOf(venue, target);
  parallelFor(0, corrected.inside.size(), 4096, [&](std::size_t i) {
    if (target.inside[i] == 0) return;
    using Colour = Eigen::Map<const Eigen::Vector3f>;
    const Colour asked(&target.asked[3 * i]);
    Eigen::Map<Eigen::Vector3f> corrects(&corrected.asked[3 * i]);
    corrects = held(Colour(&target.wanted[3 * i]) - Colour(&venue.black[3 * i]) - Colour(&unexplained[3 * i]),
                    asked.cwiseMin(0.0f), asked.cwiseMax(Colour(&flood[3 * i])), target.clipping);
  });
  return compensator.goOn(corrected, std::move(p), rounds, progress);
}

}  // namespace relucent::compensation
