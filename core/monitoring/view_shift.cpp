// SPDX-License-Identifier: MIT
#include "relucent/monitoring/view_shift.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "relucent/monitoring/tukey.h"

namespace relucent::monitoring {
namespace {

// A patch knows its place no better than this, camera pixels, whatever its pixels say.
constexpr double patchDeviation = 0.15;
constexpr int leastPixels = 12;  // of a patch that tell
constexpr std::size_t leastPatches = 4;

/// One patch's channel, smoothed; 0 valid beside its border and what is saturated.
struct Plane {
  Size size;
  std::vector<double> seen, predicted, along;
  std::vector<std::uint8_t> valid;
  std::size_t at(int x, int y) const { return indexOf(size, {x, y}); }
};

Plane planeOf(const Patch& patch, std::size_t channel, const Observed& seen,
              const std::vector<float>& predicted, const std::vector<float>& along) {
  const Size size = patch.size;
  Plane plane{size, std::vector<double>(size.count()), std::vector<double>(size.count()),
              std::vector<double>(size.count()), std::vector<std::uint8_t>(size.count(), 0)};
  for (int y = 1; y + 1 < size.height; ++y)
    for (int x = 1; x + 1 < size.width; ++x) {
      double sumSeen = 0.0, sumPredicted = 0.0, sumAlong = 0.0;
      bool isValid = true;
      for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) {
          const std::size_t i = 3 * patch.samples[plane.at(x + dx, y + dy)] + channel;
          const double weight = (2 - std::abs(dx)) * (2 - std::abs(dy)) / 16.0;
          sumSeen += weight * seen.radiance[i];
          sumPredicted += weight * predicted[i];
          if (!along.empty()) sumAlong += weight * along[i];
          isValid = isValid && seen.valid[i] != 0;
        }
      plane.seen[plane.at(x, y)] = sumSeen;
      plane.predicted[plane.at(x, y)] = sumPredicted;
      plane.along[plane.at(x, y)] = sumAlong;
      plane.valid[plane.at(x, y)] = isValid;
    }
  return plane;
}

/// Normal equations of a patch's d: information I and right sides I d, of the photograph and of time.
struct PatchEquations {
  Eigen::Matrix2d information = Eigen::Matrix2d::Zero();
  Eigen::Matrix2d right = Eigen::Matrix2d::Zero();
};

void addChannel(const Plane& plane, double noise, double wrong, PatchEquations& sum) {
  std::vector<Eigen::Vector4d> x;  // gradient, 1, q
  std::vector<Eigen::Vector2d> r;  // of the photograph, of time
  for (int v = 2; v + 2 < plane.size.height; ++v)
    for (int u = 2; u + 2 < plane.size.width; ++u) {
      if (!plane.valid[plane.at(u, v)] || !plane.valid[plane.at(u + 1, v)] ||
          !plane.valid[plane.at(u - 1, v)] || !plane.valid[plane.at(u, v + 1)] ||
          !plane.valid[plane.at(u, v - 1)])
        continue;
      const double q = plane.predicted[plane.at(u, v)];
      const double gx = 0.5 * (plane.predicted[plane.at(u + 1, v)] - plane.predicted[plane.at(u - 1, v)]);
      const double gy = 0.5 * (plane.predicted[plane.at(u, v + 1)] - plane.predicted[plane.at(u, v - 1)]);
      x.emplace_back(-gx, -gy, 1.0, q);
      r.emplace_back(plane.seen[plane.at(u, v)] - q, plane.along[plane.at(u, v)]);
    }
  if (x.size() < leastPixels) return;
  // Brightness is taken out of the residuals and of both gradients.
  Eigen::Matrix2d within = Eigen::Matrix2d::Zero();
  Eigen::Matrix<double, 2, 4> cross = Eigen::Matrix<double, 2, 4>::Zero();
  double mean = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) mean += x[i][3] / static_cast<double>(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) {
    const Eigen::Vector2d one(1.0, x[i][3] - mean);
    within += one * one.transpose();
    cross += one * Eigen::RowVector4d(x[i][0], x[i][1], r[i][0], r[i][1]);
  }
  within(1, 1) += 1e-12 + 1e-6 * mean * mean;
  const Eigen::Matrix<double, 2, 4> bright = within.ldlt().solve(cross);
  Eigen::Matrix2d information = Eigen::Matrix2d::Zero();
  Eigen::Matrix2d right = Eigen::Matrix2d::Zero();
  double squares = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const Eigen::RowVector4d left = Eigen::RowVector4d(x[i][0], x[i][1], r[i][0], r[i][1]) -
                                    Eigen::RowVector2d(1.0, x[i][3] - mean) * bright;
    const Eigen::Vector2d g(left[0], left[1]);
    information += g * g.transpose();
    right += g * left.tail<2>();
    squares += left[2] * left[2];
  }
  // What the gradient does not explain is noise, and T's errors.
  const Eigen::Matrix2d steadied = information + 1e-12 * Eigen::Matrix2d::Identity();
  const double rest = std::max(0.0, squares - right.col(0).dot(steadied.ldlt().solve(right.col(0))));
  const double floor = wrong * mean;
  const double variance = std::max(rest / static_cast<double>(x.size() - 4), noise + 0.1 * floor * floor);
  sum.information += information / variance;
  sum.right += right / variance;
}

struct PatchShift {
  Eigen::Vector2d shift, withTime;
  Eigen::Matrix2d covariance;
  Eigen::Vector2d place;  // from the view's centre, in halves of its shorter side
  double weight = 1.0;
};

}  // namespace

ViewShift viewShift(const Observed& seen, const std::vector<float>& predicted,
                    const std::vector<float>& along, const WatchedVenue& venue) {
  const Size camera = venue.sampling.camera;
  const double half = 0.5 * std::min(camera.width, camera.height);
  std::vector<PatchShift> patches;
  for (const Patch& patch : venue.sampling.patches) {
    PatchEquations equations;
    for (std::size_t c = 0; c < 3; ++c) {
      double noise = 0.0;
      for (std::uint32_t sample : patch.samples)
        noise += seen.variance[3 * sample + c] / static_cast<double>(patch.samples.size());
      constexpr double smoothed = 36.0 / 256.0;  // of independent noise
      addChannel(planeOf(patch, c, seen, predicted, along), smoothed * noise, venue.wrong, equations);
    }
    // Where only one direction tells, the other is not known: a wide prior stands for that.
    const Eigen::Matrix2d information = equations.information + 0.01 * Eigen::Matrix2d::Identity();
    const Eigen::LDLT<Eigen::Matrix2d> solver(information);
    PatchShift one;
    const Eigen::Matrix2d both = solver.solve(equations.right);
    one.shift = both.col(0);
    one.withTime = both.col(1);
    one.covariance = solver.solve(Eigen::Matrix2d::Identity()) +
                     patchDeviation * patchDeviation * Eigen::Matrix2d::Identity();
    const Pixel first = pixelAt(camera, venue.sampling.pixels[patch.samples.front()]);
    one.place = Eigen::Vector2d(first.x + 0.5 * (patch.size.width - camera.width),
                                first.y + 0.5 * (patch.size.height - camera.height)) /
                half;
    patches.push_back(one);
  }
  ViewShift result;
  if (patches.size() < leastPatches) return result;

  Eigen::Vector4d theta = Eigen::Vector4d::Zero();
  Eigen::Matrix4d normal;
  const auto designOf = [](const PatchShift& patch) {
    Eigen::Matrix<double, 2, 4> design;
    design << 1.0, 0.0, -patch.place.y(), patch.withTime.x(), 0.0, 1.0, patch.place.x(), patch.withTime.y();
    return design;
  };
  for (double width : {4.0, 2.0, 1.0, 1.0, 1.0}) {
    // Before any look: moved by 5 pixels, turned by 2, a moment that is half of a step off.
    normal = Eigen::Vector4d(0.04, 0.04, 0.25, 4.0).asDiagonal();
    Eigen::Vector4d right = Eigen::Vector4d::Zero();
    for (PatchShift& patch : patches) {
      const Eigen::Matrix2d information = patch.covariance.inverse();
      const Eigen::Matrix<double, 2, 4> design = designOf(patch);
      const Eigen::Vector2d left = patch.shift - design * theta;
      patch.weight = tukeyWeight(left.dot(information * left) / (2.0 * width * width));
      normal += patch.weight * design.transpose() * information * design;
      right += patch.weight * design.transpose() * information * patch.shift;
    }
    theta = normal.ldlt().solve(right);
  }
  Eigen::Matrix4d middle = normal;
  for (const PatchShift& patch : patches) {
    const Eigen::Matrix<double, 2, 4> design = designOf(patch);
    const Eigen::Vector4d score =
        patch.weight * design.transpose() * patch.covariance.inverse() * (patch.shift - design * theta);
    middle += score * score.transpose();
  }
  const Eigen::Matrix4d inverse = normal.inverse(), covariance = inverse * middle * inverse;
  result.x = theta[0];
  result.y = theta[1];
  result.turn = theta[2];
  result.deviation = std::sqrt(std::max(covariance(0, 0), covariance(1, 1)));
  return result;
}

}  // namespace relucent::monitoring
