// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

namespace relucent::hdr {

/// A strictly increasing curve on [0, 1], monotone cubic between samples (Fritsch & Carlson 1980). Projector
/// channels: drive -> relative radiance, 0 -> 0, 1 -> 1. Cameras: signal -> linear signal. Outside [0, 1] it
/// continues linearly, so that noise around black is not clipped.
class ResponseCurve {
 public:
  /// The identity.
  ResponseCurve();
  /// Through (x, y), x ascending from 0 to 1, y ascending. x() and y() are sufficient to construct a
  /// bit-identical curve.
  /// Throws: Error{numerics} if the samples do not ascend or are not finite.
  ResponseCurve(std::vector<double> x, std::vector<double> y);

  double operator()(double x) const;
  /// dy/dx.
  double slope(double x) const;
  /// The x for which operator() gives y, to 1e-12; y is clamped to the curve's range on [0, 1].
  double inverse(double y) const;
  bool isIdentity() const { return identity_; }
  const std::vector<double>& x() const { return x_; }
  const std::vector<double>& y() const { return y_; }

  bool operator==(const ResponseCurve&) const = default;

 private:
  std::size_t segment(double x) const;
  double valueIn(std::size_t segment, double x) const;
  double slopeIn(std::size_t segment, double x) const;

  std::vector<double> x_, y_, slope_;
  bool identity_ = false;
};

}  // namespace relucent::hdr
