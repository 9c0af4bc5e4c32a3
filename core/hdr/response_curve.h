// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

namespace relucent {

/// A strictly increasing curve on [0, 1], monotone cubic between samples (Fritsch & Carlson 1980).
/// Projector channels: drive -> relative radiance, 0 -> 0, 1 -> 1. Cameras: signal -> linear signal.
class ResponseCurve {
 public:
  /// The identity.
  ResponseCurve();
  /// Through (x, y), x ascending from 0 to 1, y ascending.
  /// Throws: Error{numerics} if the samples do not ascend.
  ResponseCurve(std::vector<double> x, std::vector<double> y);

  double operator()(double x) const;
  /// The x for which operator() gives y; y is clamped to the curve's range.
  double inverse(double y) const;
  bool isIdentity() const;
  const std::vector<double>& x() const { return x_; }
  const std::vector<double>& y() const { return y_; }

 private:
  std::vector<double> x_, y_, slope_;
};

}  // namespace relucent
