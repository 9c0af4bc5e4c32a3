// SPDX-License-Identifier: MIT
#include "relucent/sentinels/movement.h"

#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "relucent/base/error.h"

namespace relucent::sentinels {
namespace {

constexpr int mostRounds = 4;

cv::Mat matOf(const image::Image& image) {
  return cv::Mat(image.height(), image.width(), CV_32F, const_cast<float*>(image.data().data())).clone();
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
    cv::Rect part(quarter % 2 * halfWidth, quarter / 2 * halfHeight, halfWidth, halfHeight);
    cv::Point2d shift = shiftBetween(first(part), now(part));
    double x = (quarter % 2 - 0.5) * halfWidth, y = (quarter / 2 - 0.5) * halfHeight;
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

}  // namespace

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
