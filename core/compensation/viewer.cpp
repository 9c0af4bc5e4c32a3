// SPDX-License-Identifier: MIT
#include "relucent/compensation/viewer.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "relucent/base/error.h"
#include "relucent/compensation/dense_box.h"

namespace relucent::compensation {
namespace {

constexpr double lift = 1e-3;  // square root of kappa

double squaredDistance(const Position& a, const Position& b) {
  double sum = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += (a[k] - b[k]) * (a[k] - b[k]);
  return sum;
}

}  // namespace

bool isFinite(const Position& position) {
  return std::ranges::all_of(position, [](double value) { return std::isfinite(value); });
}

double widestDistance(std::span<const Position> positions) {
  double most = 0.0;
  for (std::size_t a = 0; a < positions.size(); ++a)
    for (std::size_t b = a + 1; b < positions.size(); ++b)
      most = std::max(most, squaredDistance(positions[a], positions[b]));
  return std::sqrt(most);
}

std::vector<double> viewerWeights(std::span<const Position> cameras, const Position& viewer) {
  require(!cameras.empty() && isFinite(viewer) && std::ranges::all_of(cameras, isFinite),
          "a viewer and {} cameras whose positions must be finite", cameras.size());
  const double scale = widestDistance(cameras);
  if (!(scale > 0.0)) return std::vector<double>(cameras.size(), 1.0 / static_cast<double>(cameras.size()));

  // The point of a polytope that is nearest to the origin, as non-negative least squares: with a row of ones
  // whose sum is to be one below the points, the solution is in proportion to its weights (Wolfe 1976), in
  // whatever units the points are: such that none lies beyond 1.
  constexpr Eigen::Index rows = 5;
  Eigen::MatrixXd a(rows, static_cast<Eigen::Index>(cameras.size()));
  for (std::size_t c = 0; c < cameras.size(); ++c) {
    const auto column = static_cast<Eigen::Index>(c);
    for (std::size_t k = 0; k < viewer.size(); ++k)
      a(static_cast<Eigen::Index>(k), column) = (cameras[c][k] - viewer[k]) / scale;
    a(3, column) = lift * squaredDistance(cameras[c], viewer) / (scale * scale);
    a(4, column) = 1.0;
  }
  a.topRows(rows - 1) /= a.topRows(rows - 1).colwise().norm().maxCoeff();
  const Eigen::VectorXd b = Eigen::VectorXd::Unit(rows, rows - 1);
  Progress silent;
  const DenseBoxResult solved = solveDenseBox(a, b, {}, silent);
  // A view that counts for what is left of roundings is not asked.
  constexpr double least = 1e-6;
  std::vector<double> weights;
  double sum = 0.0;
  for (double share : solved.x / solved.x.sum()) sum += weights.emplace_back(share > least ? share : 0.0);
  for (double& weight : weights) weight /= sum;
  return weights;
}

std::vector<double> followedWeights(std::span<const Position> cameras, std::span<const double> home,
                                    const Position& viewer) {
  require(home.size() == cameras.size(), "{} weights of {} cameras", home.size(), cameras.size());
  constexpr double least = 1e-3;
  std::vector<double> weights = viewerWeights(cameras, viewer);
  double near = 0.0, all = 0.0;
  for (std::size_t view = 0; view < weights.size(); ++view) {
    weights[view] *= home[view];
    near += weights[view];
    all += home[view];
  }
  if (!(near > 0.0)) return {};
  for (std::size_t view = 0; view < weights.size(); ++view)
    weights[view] = std::max(weights[view] / near, least * home[view] / all);
  return weights;
}

Message farFromCameras(std::span<const Position> cameras, const Position& viewer) {
  constexpr double mostTimes = 2.0;
  const double widest = widestDistance(cameras);
  double nearest = std::numeric_limits<double>::infinity();
  for (const Position& camera : cameras) nearest = std::min(nearest, squaredDistance(camera, viewer));
  nearest = std::sqrt(nearest);
  if (!(widest > 0.0) || nearest <= mostTimes * widest) return {};
  return RELUCENT_ENGLISH_MESSAGE(
             "viewer.far-from-cameras",
             "the viewer stands {} from the nearest camera, and no two cameras stand further "
             "apart than {}")
      .with(as::number(nearest, as::digits(3)), as::number(widest, as::digits(3)));
}

std::vector<Message> problems(const ViewerMotionSettings& settings) {
  std::vector<Message> found;
  if (!(settings.patience.count() >= 0.0 && std::isfinite(settings.patience.count())))
    found.push_back(RELUCENT_ENGLISH_MESSAGE(
        "viewer.patience-negative", "the time that a viewer's last position holds must be 0 s or more"));
  if (!(settings.glide.count() > 0.0 && std::isfinite(settings.glide.count())))
    found.push_back(RELUCENT_ENGLISH_MESSAGE(
        "viewer.glide-not-positive", "the time of the way back to the sweet spot must be more than 0 s"));
  return found;
}

MovingViewer::MovingViewer(const Position& sweetSpot, const ViewerMotionSettings& settings)
    : sweetSpot_(sweetSpot), settings_(settings) {
  const std::vector<Message> wrong = problems(settings);
  require(isFinite(sweetSpot) && wrong.empty(), "a viewer's motion: {}", fmt::join(wrong, "; "));
}

bool MovingViewer::moveTo(const Position& position, Time now) {
  if (!isFinite(position)) return false;
  last_ = position;
  told_ = now;
  return true;
}

double MovingViewer::presence(Time now) const {
  if (!last_) return 0.0;
  const Time since = now - told_ - settings_.patience;
  if (since <= Time(0.0)) return 1.0;
  // Nobody sees the rest, and a picture that does not change need not be computed.
  constexpr double least = 1e-3;
  const double share = std::exp(-since / settings_.glide);
  return share >= least ? share : 0.0;
}

Position MovingViewer::at(Time now) const {
  const double share = presence(now);
  if (share == 1.0) return *last_;
  if (share == 0.0) return sweetSpot_;
  Position position = sweetSpot_;
  for (std::size_t k = 0; k < position.size(); ++k) position[k] += share * ((*last_)[k] - sweetSpot_[k]);
  return position;
}

}  // namespace relucent::compensation
