// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "relucent/base/progress.h"
#include "relucent/compensation/methods.h"
#include "relucent/hdr/hdr.h"

namespace relucent::compensation {

/// What the cameras see beyond T's prediction, value by value, learned from photographs of projections:
///   b <- b + k (d - b),   d = photograph - e - T p,   k = q / (q + variance of the photograph)
///   q <- (1 - k) q + t^2 (change of T p)^2
/// q is the variance of what is not known of b yet. At first, of all values that are about as bright (octaves
/// of T p) in the first photograph: mean of d^2 - variance, less its standard error, not below 0; where these
/// are few, t^2 (T p)^2. t is how wrong T is, relative to light: t^2 = max(0, sum (d^2 - variance)) / sum (T
/// p)^2 of the first photograph. So noise is not carried into the picture: b is believed as far as
/// photographs show more than their noise.
class Unexplained {
 public:
  explicit Unexplained(const MeasuredVenue& venue);

  /// `light`: photograph less e, as it was when it was taken; `predicted`: T p of what it shows. Values that
  /// are not valid teach nothing.
  void learn(const hdr::HdrFrame& light, const CameraStack& predicted);
  /// b. Shape: camera stack.
  const CameraStack& value() const { return value_; }
  /// t: 0 before the first photograph.
  double relative() const { return relative_; }

 private:
  void begin(const hdr::HdrFrame& light, const CameraStack& predicted);

  const MeasuredVenue& venue_;
  CameraStack value_, uncertainty_, predicted_;
  double relative_ = 0.0;
};

/// How far a photographed projection is from what is wanted, as the solve weighs it:
///   E = sum w (|light - asked|^2 - variance) / sum w |asked|^2  over valid values.
/// Without noise and error 0; noise alone gives 0 on the average, give or take `deviation`.
struct WeighedError {
  double value = 0.0;
  double deviation = 0.0;  // standard deviation of it, by the photograph's noise
};
/// Shapes: of the target's cameras.
WeighedError weighedError(const hdr::HdrFrame& light, const Target& target);

/// Solves again for what T did not explain: from p, `rounds` times the steps of `refined` with
/// wanted - e - b in place of wanted - e, held as the target's was.
Compensation solvedAgain(const Compensator& compensator, const Target& target, const CameraStack& unexplained,
                         Compensation p, int rounds, Progress& progress);

}  // namespace relucent::compensation
