// SPDX-License-Identifier: MIT
#include "relucent/acquisition/estimate.h"

namespace relucent::acquisition {

void reconcile(const Estimate& parent, std::span<Estimate> children) {
  transport::ColourBlock sum = transport::ColourBlock::Zero(), variance = parent.variance;
  for (const Estimate& child : children) {
    sum += child.value;
    variance += child.variance;
  }
  for (Estimate& child : children) {
    for (int i = 0; i < 9; ++i) {
      if (variance.data()[i] <= 0.0f) continue;
      float gain = child.variance.data()[i] / variance.data()[i];
      child.value.data()[i] += gain * (parent.value.data()[i] - sum.data()[i]);
      child.variance.data()[i] *= 1.0f - gain;
    }
  }
}

}  // namespace relucent::acquisition
