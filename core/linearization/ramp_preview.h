// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <map>

#include "rig/rig.h"

namespace relucent {

/// What a projector's ramps look like while they are being measured: drive -> light, seen roughly, without
/// the weights, drift and noise of the fit. For the eye only.
class RampPreview {
 public:
  /// One photograph of an even pattern; others, and those that are saturated, tell nothing.
  void add(const Image& encodedPattern, const RawFrame& frame);

  /// Per channel: drive -> light relative to the brightest level so far, less black. Empty until black and
  /// some level have been seen.
  std::array<std::map<double, double>, 3> curves() const;

 private:
  struct Mean {
    double sum = 0.0;
    int frames = 0;
  };
  std::array<std::map<double, Mean>, 3> levels_;
  Mean black_;
};

}  // namespace relucent
