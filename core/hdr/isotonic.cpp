// SPDX-License-Identifier: MIT
#include "relucent/hdr/isotonic.h"

#include <algorithm>
#include <cmath>

#include "relucent/base/error.h"

namespace relucent::hdr {
namespace {

/// Neighbouring samples that share one value.
struct Pool {
  std::size_t begin = 0, end = 0;
  double weight = 0.0;
  double value = 0.0;
};

std::vector<Pool> pooled(const std::vector<double>& values, const std::vector<double>& weights) {
  require(values.size() == weights.size(), "{} weights for {} values", weights.size(), values.size());
  std::vector<Pool> pools;
  for (std::size_t i = 0; i < values.size(); ++i) {
    require(weights[i] > 0.0, "weight {} of sample {} is not positive", weights[i], i);
    pools.push_back({i, i + 1, weights[i], values[i]});
    while (pools.size() > 1 && pools[pools.size() - 2].value >= pools.back().value) {
      Pool last = pools.back();
      pools.pop_back();
      Pool& before = pools.back();
      // Equal values stay what they are, free of rounding: this is what makes the regression idempotent.
      if (before.value != last.value)
        before.value =
            (before.weight * before.value + last.weight * last.value) / (before.weight + last.weight);
      before.weight += last.weight;
      before.end = last.end;
    }
  }
  return pools;
}

struct Samples {
  std::vector<double> x, y;
  void add(double atX, double atY) {
    x.push_back(atX);
    y.push_back(atY);
  }
};

}  // namespace

std::vector<double> isotonic(const std::vector<double>& values, const std::vector<double>& weights) {
  std::vector<double> result(values.size());
  for (const Pool& pool : pooled(values, weights))
    std::fill(result.begin() + static_cast<std::ptrdiff_t>(pool.begin),
              result.begin() + static_cast<std::ptrdiff_t>(pool.end), pool.value);
  return result;
}

ResponseCurve curveFromRamp(const std::vector<double>& x, const std::vector<double>& y,
                            const std::vector<double>& weights) {
  require(x.size() == y.size() && x.size() >= 2 && x.front() == 0.0 && x.back() == 1.0,
          "a ramp of {} drives and {} values must go from 0 to 1", x.size(), y.size());
  std::vector<Pool> pools = pooled(y, weights);
  double black = pools.front().value, white = pools.back().value;
  if (pools.size() < 2 || !std::isfinite(white - black) || !(white > black))
    throw Error(ErrorKind::numerics,
                RELUCENT_ENGLISH_MESSAGE("linearization.ramp-not-rising",
                                         "the brightness does not rise along the ramp"),
                RELUCENT_ENGLISH_MESSAGE(
                    "linearization.check-projector-and-camera",
                    "check that the projector shows the pictures and that the camera sees them"));

  Samples samples;
  for (const Pool& pool : pools) {
    double value = (pool.value - black) / (white - black);
    bool first = &pool == &pools.front(), last = &pool == &pools.back();
    if (first) {
      samples.add(0.0, 0.0);
      if (pool.end - pool.begin > 1) samples.add(x[pool.end - 1], leastSlope * x[pool.end - 1]);
    } else if (last) {
      if (pool.end - pool.begin > 1) samples.add(x[pool.begin], 1.0 - leastSlope * (1.0 - x[pool.begin]));
      samples.add(1.0, 1.0);
    } else {
      double sum = 0.0;
      for (std::size_t i = pool.begin; i < pool.end; ++i) sum += weights[i] * x[i];
      samples.add(sum / pool.weight, value);
    }
  }

  // Neighbours that differ by less than the least slope, or cross the plateaus' ends, are moved apart.
  for (std::size_t i = 1; i < samples.x.size(); ++i)
    samples.y[i] =
        std::max(samples.y[i], samples.y[i - 1] + 0.5 * leastSlope * (samples.x[i] - samples.x[i - 1]));
  double reached = samples.y.back();
  for (double& value : samples.y) value /= reached;
  return ResponseCurve(std::move(samples.x), std::move(samples.y));
}

}  // namespace relucent::hdr
