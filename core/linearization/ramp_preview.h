// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <map>

#include "relucent/rig/rig.h"

namespace relucent::linearization {

/// Approximate ramps of a projector while they are being measured, drive -> light, without the weights, drift
/// correction and noise model of the fit. For display only.
class RampPreview {
 public:
  /// Adds one photograph of a uniform pattern; other patterns and saturated photographs are ignored.
  void add(const image::Image& encodedPattern, const rig::RawFrame& frame);

  /// Per channel: drive -> light relative to the brightest level so far, minus black. Empty until black and
  /// at least one level have been photographed.
  std::array<std::map<double, double>, 3> curves() const;

 private:
  struct Mean {
    double sum = 0.0;
    int frames = 0;
  };
  std::array<std::map<double, Mean>, 3> levels_;
  Mean black_;
};

}  // namespace relucent::linearization
