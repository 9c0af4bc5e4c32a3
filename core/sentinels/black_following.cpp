// SPDX-License-Identifier: MIT
#include "relucent/sentinels/black_following.h"

#include <algorithm>

#include "relucent/base/parallel.h"

namespace relucent::sentinels {
namespace {

// Mean squared deviation of a new black from e in units of both variances, above which e has changed; noise
// models are right to 10 or 20 %.
constexpr double changedBlack = 1.4;

double deviation(const hdr::BlackLevel& a, const hdr::BlackLevel& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.radiance.size(); ++i) {
    double apart = static_cast<double>(a.radiance[i] - b.radiance[i]);
    sum += apart * apart / std::max(1e-30, static_cast<double>(a.variance[i] + b.variance[i]));
  }
  return sum / static_cast<double>(std::max<std::size_t>(1, a.radiance.size()));
}

}  // namespace

bool hasChanged(const hdr::BlackLevel& a, const hdr::BlackLevel& b) {
  return deviation(a, b) > changedBlack;
}

void join(hdr::BlackLevel& into, const hdr::BlackLevel& other) {
  parallelFor(0, into.radiance.size(), 4096, [&](std::size_t i) {
    float sum = into.variance[i] + other.variance[i];
    if (!(sum > 0.0f) || !other.valid[i]) return;
    float weight = into.variance[i] / sum;
    into.radiance[i] += weight * (other.radiance[i] - into.radiance[i]);
    into.variance[i] *= 1.0f - weight;
  });
}

}  // namespace relucent::sentinels
