// SPDX-License-Identifier: MIT
#include "relucent/linearization/projector_ramp.h"

#include <algorithm>
#include <cmath>

#include "relucent/base/error.h"
#include "relucent/base/random.h"
#include "relucent/hdr/isotonic.h"

namespace relucent::linearization {
namespace {

constexpr std::size_t shotsBetweenReferences = 8;
constexpr int fullShots = 3;         // of each channel: everything is relative to them
constexpr double steadiness = 3e-4;  // of light between shots, relative; what no lamp beats

/// One shot of the ramp: a channel at a level.
struct Step {
  std::size_t channel = 0;
  std::size_t level = 0;
};

std::vector<Step> shuffledSteps(std::size_t levels, std::uint64_t seed, std::size_t projector) {
  std::vector<Step> steps;
  for (std::size_t c = 0; c < 3; ++c) {
    for (std::size_t level = 0; level < levels; ++level) steps.push_back({c, level});
    for (int again = 1; again < fullShots; ++again) steps.push_back({c, levels - 1});
  }
  Random random{seed, 7, projector};
  for (std::size_t i = steps.size(); i > 1; --i) std::swap(steps[i - 1], steps[random.below(i)]);
  return steps;
}

/// White and black at one moment, as the weighted sums that the ramps need.
struct Reference {
  double white = 0.0;             // (W - K), white's weights
  std::array<double, 3> black{};  // K, each channel's weights
};

Reference between(const Reference& a, const Reference& b, double share) {
  Reference mixed{a.white + share * (b.white - a.white), {}};
  for (std::size_t c = 0; c < 3; ++c) mixed.black[c] = a.black[c] + share * (b.black[c] - a.black[c]);
  return mixed;
}

/// Sums over one level's shots.
struct Level {
  double weighted = 0.0, weights = 0.0;
};

hdr::ResponseCurve curveOf(const std::vector<double>& drives, const std::vector<Level>& levels) {
  std::vector<double> x{0.0}, y{0.0}, weights{0.0};
  for (std::size_t i = 0; i < drives.size(); ++i) {
    x.push_back(drives[i]);
    y.push_back(levels[i].weighted / levels[i].weights);
    weights.push_back(levels[i].weights);
  }
  // Black is the zero by definition, not by one measurement.
  weights.front() = 100.0 * *std::max_element(weights.begin(), weights.end());
  return hdr::curveFromRamp(x, y, weights);
}

}  // namespace

std::vector<double> rampLevels(const LinearizationSettings& settings, int bits) {
  double codes = std::ldexp(1.0, bits) - 1.0;
  std::vector<double> levels;
  for (int k = 1; k < settings.levels; ++k) {
    double drive = std::pow(static_cast<double>(k) / (settings.levels - 1), settings.shadowPower);
    double code = std::round(drive * codes);
    if (code > 0.0 && (levels.empty() || code / codes > levels.back())) levels.push_back(code / codes);
  }
  return levels;
}

ProjectorResponse measureRamps(const LightMeter& meter, std::size_t projector, const Additivity& additivity,
                               const LinearizationSettings& settings, Progress& progress) {
  const rig::Rig& rig = meter.rig();
  std::vector<double> drives = rampLevels(settings, rig.projectors[projector]->bits());
  std::vector<Step> steps = shuffledSteps(drives.size(), settings.seed, projector);
  std::size_t references = (steps.size() + shotsBetweenReferences - 1) / shotsBetweenReferences + 1;
  double shots = static_cast<double>(steps.size() + 2 * references), taken = 0.0;
  auto shoot = [&](Drive drive) {
    hdr::HdrFrame frame = meter.measure(evenPatterns(rig, projector, drive), progress);
    progress.report(++taken / shots);
    return frame;
  };
  auto reference = [&] {
    hdr::HdrFrame white = shoot({1, 1, 1}), black = shoot({0, 0, 0});
    Reference result{additivity.whiteWeights.of(white) - additivity.whiteWeights.of(black), {}};
    for (std::size_t c = 0; c < 3; ++c) result.black[c] = additivity.channelWeights[c].of(black);
    return result;
  };

  std::array<std::vector<Level>, 3> levels;
  levels.fill(std::vector<Level>(drives.size()));
  struct Reading {
    Step step;
    double light, variance;
  };
  Reference first = reference(), before = first;
  for (std::size_t begin = 0; begin < steps.size(); begin += shotsBetweenReferences) {
    std::size_t end = std::min(begin + shotsBetweenReferences, steps.size());
    std::vector<Reading> readings;
    for (std::size_t i = begin; i < end; ++i) {
      Drive drive{};
      drive[steps[i].channel] = static_cast<float>(drives[steps[i].level]);
      hdr::HdrFrame frame = shoot(drive);
      const LightWeights& weights = additivity.channelWeights[steps[i].channel];
      readings.push_back({steps[i], weights.of(frame), weights.varianceOf(frame)});
    }
    Reference after = reference();
    for (std::size_t i = 0; i < readings.size(); ++i) {
      double share = static_cast<double>(i + 1) / static_cast<double>(readings.size() + 1);
      Reference now = between(before, after, share);
      double lamp = now.white / first.white;
      double light = (readings[i].light - now.black[readings[i].step.channel]) / lamp;
      double unsteady = steadiness * readings[i].light;
      double weight = 1.0 / (readings[i].variance + unsteady * unsteady);
      Level& level = levels[readings[i].step.channel][readings[i].step.level];
      level.weighted += weight * light;
      level.weights += weight;
    }
    before = after;
  }

  ProjectorResponse response;
  for (std::size_t c = 0; c < 3; ++c) response.channels[c] = curveOf(drives, levels[c]);
  return response;
}

}  // namespace relucent::linearization
