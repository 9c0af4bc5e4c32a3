// SPDX-License-Identifier: MIT
#include "relucent/sentinels/movement.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <opencv2/imgproc.hpp>

#include "relucent/base/error.h"
#include "relucent/base/parallel.h"

namespace relucent::sentinels {
namespace {

constexpr int mostRounds = 4;
// Pixels within which two movements lead to the same one: bilinear interpolation is smooth there.
constexpr double sameBasin = 0.1;

cv::Mat matOf(const image::Image& image) {
  return cv::Mat(image.height(), image.width(), CV_32F, const_cast<float*>(image.data().data())).clone();
}

/// Empty: all of it is compared.
cv::Mat maskOf(const ViewPair& view) {
  cv::Mat mask;
  if (view.compared.empty()) return mask;
  cv::Mat(view.first.height(), view.first.width(), CV_8U, const_cast<std::uint8_t*>(view.compared.data()))
      .convertTo(mask, CV_32F);
  return cv::min(mask, 1.0);
}

cv::Point2d shiftBetween(const cv::Mat& first, const cv::Mat& now) {
  cv::Mat window;
  cv::createHanningWindow(window, first.size(), CV_32F);
  // Copies: the function windows its inputs in place.
  return cv::phaseCorrelate(first.clone(), now.clone(), window);
}

/// Rotation about the centre, from how far the quarters were shifted across their distance from it.
double turnBetween(const cv::Mat& first, const cv::Mat& now) {
  int halfWidth = first.cols / 2, halfHeight = first.rows / 2;
  double across = 0.0, distance = 0.0;
  for (int quarter = 0; quarter < 4; ++quarter) {
    const int column = quarter % 2, line = quarter / 2;
    cv::Rect part(column * halfWidth, line * halfHeight, halfWidth, halfHeight);
    cv::Point2d shift = shiftBetween(first(part), now(part));
    double x = (column - 0.5) * halfWidth, y = (line - 0.5) * halfHeight;
    across += x * shift.y - y * shift.x;
    distance += x * x + y * y;
  }
  return distance > 0.0 ? across / distance : 0.0;
}

cv::Mat moved(const cv::Mat& first, cv::Point2d shift, double turn) {
  double cx = 0.5 * (first.cols - 1), cy = 0.5 * (first.rows - 1), c = std::cos(turn), s = std::sin(turn);
  cv::Mat_<double> matrix(2, 3);
  matrix << c, -s, cx - c * cx + s * cy + shift.x, s, c, cy - s * cx - c * cy + shift.y;
  cv::Mat result;
  cv::warpAffine(first, result, matrix, first.size(), cv::INTER_LINEAR, cv::BORDER_REPLICATE);
  return result;
}

/// Of several pictures: how far they are apart after a movement (x, y, pixels; angle), and the steps that
/// bring them nearer.
class Registration {
 public:
  explicit Registration(const std::vector<ViewPair>& views) {
    for (const ViewPair& view : views) {
      first_.push_back(matOf(view.first));
      now_.push_back(matOf(view.now));
      compared_.push_back(maskOf(view));
    }
    const cv::Size size = first_.front().size();
    const int margin = std::max(2, std::min(size.width, size.height) / 16);
    inside_ = cv::Rect(margin, margin, size.width - 2 * margin, size.height - 2 * margin);
    // Turning by one unit moves what lies halfway to the border by one pixel.
    angle_ = 4.0 / std::max(1, std::min(size.width, size.height));
  }

  double apart(const Eigen::Vector3d& movement) const {
    std::vector<double> squares(first_.size());
    parallelFor(0, squares.size(), 1,
                [&](std::size_t i) { squares[i] = residual(i, movement).squaredNorm(); });
    return std::accumulate(squares.begin(), squares.end(), 0.0);
  }

  Eigen::Vector3d improved(Eigen::Vector3d movement) const {
    constexpr int mostSteps = 12;
    constexpr double enough = 1e-3;  // pixels
    double now = apart(movement);
    for (int step = 0; step < mostSteps; ++step) {
      Eigen::Vector3d by = newtonStep(movement);
      double after = apart(movement + by);
      for (int half = 0; half < 4 && !(after < now); ++half) after = apart(movement + (by *= 0.5));
      if (!(after < now)) break;
      movement += by;
      now = after;
      if (by.norm() < enough) break;
    }
    return movement;
  }

  Movement movement(const Eigen::Vector3d& of) const {
    return {of.x(), of.y(), of.z() * angle_ * 180.0 / std::numbers::pi, false};
  }
  Eigen::Vector3d parameters(const Movement& movement) const {
    return {movement.x, movement.y, movement.degrees * std::numbers::pi / 180.0 / angle_};
  }

 private:
  cv::Mat movedBy(const cv::Mat& picture, const Eigen::Vector3d& by) const {
    return moved(picture, {by.x(), by.y()}, by.z() * angle_);
  }

  /// 1 where a pixel is compared and the light that has come there is, 0 elsewhere; empty: everywhere. What
  /// is left out stands still, and would hold the movement back.
  cv::Mat comparedAt(std::size_t i, const Eigen::Vector3d& by) const {
    constexpr double whole = 0.999;  // interpolated of nothing that is left out
    if (compared_[i].empty()) return {};
    cv::Mat all;
    cv::threshold(movedBy(compared_[i], by), all, whole, 1.0, cv::THRESH_BINARY);
    return all.mul(compared_[i])(inside_);
  }

  Eigen::VectorXd residual(std::size_t i, const Eigen::Vector3d& by) const {
    return residual(i, by, comparedAt(i, by));
  }
  Eigen::VectorXd residual(std::size_t i, const Eigen::Vector3d& by, const cv::Mat& compared) const {
    cv::Mat there = movedBy(first_[i], by)(inside_), here = now_[i](inside_);
    if (!compared.empty()) {
      there = there.mul(compared);
      here = here.mul(compared);
    }
    const double whole = cv::norm(here), square = there.dot(there);
    if (!(whole > 0.0)) return Eigen::VectorXd::Zero(1);
    const double gain = square > 0.0 ? there.dot(here) / square : 0.0;
    const cv::Mat difference = (here - gain * there) / whole;
    Eigen::VectorXd values(difference.total());
    std::copy(difference.begin<float>(), difference.end<float>(), values.begin());
    return values;
  }

  Eigen::Vector3d newtonStep(const Eigen::Vector3d& at) const {
    constexpr double h = 0.25;  // pixels, within which bilinear interpolation is smooth enough
    std::vector<Eigen::Matrix3d> squares(first_.size());
    std::vector<Eigen::Vector3d> slopes(first_.size());
    parallelFor(0, first_.size(), 1, [&](std::size_t i) {
      const cv::Mat compared = comparedAt(i, at);
      const Eigen::VectorXd here = residual(i, at, compared);
      Eigen::MatrixXd jacobian(here.size(), 3);
      for (int k = 0; k < 3; ++k)
        jacobian.col(k) = (residual(i, at + h * Eigen::Vector3d::Unit(k), compared) -
                           residual(i, at - h * Eigen::Vector3d::Unit(k), compared)) /
                          (2.0 * h);
      squares[i] = jacobian.transpose() * jacobian;
      slopes[i] = jacobian.transpose() * here;
    });
    Eigen::Matrix3d square = Eigen::Matrix3d::Zero();
    Eigen::Vector3d slope = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < first_.size(); ++i) {
      square += squares[i];
      slope += slopes[i];
    }
    return -square.completeOrthogonalDecomposition().solve(slope);
  }

  std::vector<cv::Mat> first_, now_, compared_;
  cv::Rect inside_;
  double angle_ = 1.0;
};

}  // namespace

Movement movementBetween(const std::vector<ViewPair>& views) {
  require(!views.empty(), "no views to compare");
  for (const ViewPair& view : views)
    require(view.first.size() == views.front().first.size() &&
                (view.compared.empty() || view.compared.size() == view.first.size().count()),
            "views of several sizes");
  std::vector<Movement> found(1 + views.size());
  parallelFor(0, views.size(), 1,
              [&](std::size_t i) { found[1 + i] = movementBetween(views[i].first, views[i].now); });
  const Size size = views.front().first.size();
  if (size.width < 8 || size.height < 8) return {};
  const Registration registration(views);
  const double before = registration.apart(Eigen::Vector3d::Zero());
  Eigen::Vector3d best = Eigen::Vector3d::Zero();
  double least = before;
  std::vector<Eigen::Vector3d> known;  // where was begun, and where that led to
  for (const Movement& movement : found) {
    const Eigen::Vector3d start = registration.parameters(movement);
    if (std::ranges::any_of(known, [&](const auto& one) { return (one - start).norm() < sameBasin; }))
      continue;
    const Eigen::Vector3d end = registration.improved(start);
    known.push_back(start);
    known.push_back(end);
    const double apart = registration.apart(end);
    if (!(apart < least)) continue;
    least = apart;
    best = end;
  }
  Movement movement = registration.movement(best);
  movement.explains = least < 0.5 * before;
  return movement;
}

Movement movementBetween(const image::Image& first, const image::Image& now) {
  require(first.size() == now.size() && first.channels() == 1 && now.channels() == 1,
          "views of {}x{} and {}x{} pixels", first.width(), first.height(), now.width(), now.height());
  Movement movement;
  if (first.width() < 8 || first.height() < 8) return movement;  // too few pixels to correlate
  cv::Mat before = matOf(first), after = matOf(now);
  double difference = cv::norm(before, after), best = difference;
  cv::Point2d shift;
  double turn = 0.0;
  // Windows bias a shift towards zero; what is left of it shows when the first picture has been moved by it.
  bool better = difference > 0.0;
  for (int round = 0; round < mostRounds && better; ++round) {
    cv::Mat reached = moved(before, shift, turn);
    cv::Point2d further = shift + shiftBetween(reached, after);
    double turned = turn + turnBetween(reached, after);
    better = false;
    for (double candidate : {turn, turned}) {
      double left = cv::norm(moved(before, further, candidate), after);
      if (!(left < best)) continue;
      best = left;
      movement = {further.x, further.y, candidate * 180.0 / std::numbers::pi, false};
      better = true;
    }
    shift = {movement.x, movement.y};
    turn = movement.degrees * std::numbers::pi / 180.0;
  }
  movement.explains = best < 0.7 * difference;  // half of the squared difference
  return movement;
}

}  // namespace relucent::sentinels
