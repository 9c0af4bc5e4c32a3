// SPDX-License-Identifier: MIT
#include "relucent/hdr/response_curve.h"

#include <algorithm>
#include <cmath>

#include "relucent/base/error.h"

namespace relucent::hdr {
namespace {

bool ascends(const std::vector<double>& values) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!std::isfinite(values[i])) return false;
    if (i > 0 && !(values[i] > values[i - 1])) return false;
  }
  return true;
}

/// Slopes at the samples: three-point estimates, shrunk where a segment would overshoot.
std::vector<double> monotoneSlopes(const std::vector<double>& x, const std::vector<double>& y) {
  std::size_t segments = x.size() - 1;
  std::vector<double> secant(segments);
  for (std::size_t i = 0; i < segments; ++i) secant[i] = (y[i + 1] - y[i]) / (x[i + 1] - x[i]);

  std::vector<double> slope(x.size());
  for (std::size_t i = 1; i < segments; ++i) {
    double before = x[i] - x[i - 1], after = x[i + 1] - x[i];
    slope[i] = (after * secant[i - 1] + before * secant[i]) / (before + after);
  }
  // The ends continue the parabola through the first and last three samples.
  slope.front() = segments > 1 ? std::max(0.0, 2.0 * secant.front() - slope[1]) : secant.front();
  slope.back() = segments > 1 ? std::max(0.0, 2.0 * secant.back() - slope[segments - 1]) : secant.back();

  // Fritsch & Carlson: (alpha, beta) inside a circle of radius 3 keeps the segment monotone.
  for (std::size_t i = 0; i < segments; ++i) {
    double alpha = slope[i] / secant[i], beta = slope[i + 1] / secant[i];
    double radius = std::hypot(alpha, beta);
    if (radius <= 3.0) continue;
    slope[i] = 3.0 * alpha / radius * secant[i];
    slope[i + 1] = 3.0 * beta / radius * secant[i];
  }
  return slope;
}

}  // namespace

ResponseCurve::ResponseCurve() : ResponseCurve({0.0, 1.0}, {0.0, 1.0}) {}

ResponseCurve::ResponseCurve(std::vector<double> x, std::vector<double> y)
    : x_(std::move(x)), y_(std::move(y)) {
  bool usable = x_.size() == y_.size() && x_.size() >= 2 && x_.front() == 0.0 && x_.back() == 1.0;
  if (!usable || !ascends(x_) || !ascends(y_))
    throw Error(ErrorKind::numerics,
                RELUCENT_ENGLISH_MESSAGE("linearization.curve-not-ascending",
                                         "{} samples do not make an ascending curve")
                    .with(x_.size()),
                RELUCENT_ENGLISH_MESSAGE(
                    "linearization.measure-response-again",
                    "measure the response again; check that nothing moved and no light changed meanwhile"));
  slope_ = monotoneSlopes(x_, y_);
  identity_ = x_ == y_;
}

std::size_t ResponseCurve::segment(double x) const {
  auto after = std::upper_bound(x_.begin() + 1, x_.end() - 1, x);
  return static_cast<std::size_t>(after - x_.begin()) - 1;
}

double ResponseCurve::valueIn(std::size_t i, double x) const {
  double width = x_[i + 1] - x_[i];
  double t = (x - x_[i]) / width;
  double rise = y_[i + 1] - y_[i];
  double a = slope_[i] * width, b = slope_[i + 1] * width;
  // Hermite form, written from the left sample so that y is exact there.
  return y_[i] + t * (a + t * ((3.0 * rise - 2.0 * a - b) + t * (a + b - 2.0 * rise)));
}

double ResponseCurve::slopeIn(std::size_t i, double x) const {
  double width = x_[i + 1] - x_[i];
  double t = (x - x_[i]) / width;
  double rise = y_[i + 1] - y_[i];
  double a = slope_[i] * width, b = slope_[i + 1] * width;
  return (a + t * (2.0 * (3.0 * rise - 2.0 * a - b) + t * 3.0 * (a + b - 2.0 * rise))) / width;
}

double ResponseCurve::operator()(double x) const {
  if (identity_) return x;
  if (x <= 0.0) return y_.front() + x * slope_.front();
  if (x >= 1.0) return y_.back() + (x - 1.0) * slope_.back();
  return valueIn(segment(x), x);
}

double ResponseCurve::slope(double x) const {
  if (x <= 0.0) return slope_.front();
  if (x >= 1.0) return slope_.back();
  return slopeIn(segment(x), x);
}

double ResponseCurve::inverse(double y) const {
  if (!(y > y_.front())) return 0.0;
  if (y >= y_.back()) return 1.0;
  if (identity_) return y;
  auto after = std::upper_bound(y_.begin() + 1, y_.end() - 1, y);
  std::size_t i = static_cast<std::size_t>(after - y_.begin()) - 1;

  // Newton inside a shrinking bracket; where it would leave the bracket, halve.
  double low = x_[i], high = x_[i + 1];
  double x = low + (high - low) * (y - y_[i]) / (y_[i + 1] - y_[i]);
  for (int step = 0; step < 64 && high - low > 1e-15; ++step) {
    double error = valueIn(i, x) - y;
    (error > 0.0 ? high : low) = x;
    double slope = slopeIn(i, x);
    double next = slope > 0.0 ? x - error / slope : low;
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    if (std::abs(next - x) < 1e-15) return next;
    x = next;
  }
  return x;
}

}  // namespace relucent::hdr
