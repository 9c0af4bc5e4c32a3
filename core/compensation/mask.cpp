// SPDX-License-Identifier: MIT
#include "relucent/compensation/mask.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "relucent/base/require.h"

namespace relucent::compensation {
namespace {

using Point = std::array<double, 2>;

constexpr int pieces = 12;              // of a curve, from point to point
constexpr double leastArea = 1e-5;      // of the view
constexpr double leastDistance = 1e-6;  // of neighbouring points

double distance(const Point& a, const Point& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1]);
}

Point between(const Point& a, const Point& b, double from, double to, double at) {
  const double share = (at - from) / (to - from);
  return {a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1])};
}

/// A piece of the spline, from b to c, by Barry's and Goldman's pyramid of means.
void addPiece(const Point& a, const Point& b, const Point& c, const Point& d, std::vector<Point>& outline) {
  const double t0 = 0.0, t1 = t0 + std::sqrt(distance(a, b)), t2 = t1 + std::sqrt(distance(b, c)),
               t3 = t2 + std::sqrt(distance(c, d));
  for (int piece = 0; piece < pieces; ++piece) {
    const double t = t1 + (t2 - t1) * piece / pieces;
    const Point ab = between(a, b, t0, t1, t), bc = between(b, c, t1, t2, t), cd = between(c, d, t2, t3, t);
    const Point ac = between(ab, bc, t0, t2, t), bd = between(bc, cd, t1, t3, t);
    outline.push_back(between(ac, bd, t1, t2, t));
  }
}

double cross(const Point& o, const Point& a, const Point& b) {
  return (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0]);
}

/// Whether p, on the line through a and b, lies between them.
bool isBetween(const Point& a, const Point& b, const Point& p) {
  return std::min(a[0], b[0]) <= p[0] && p[0] <= std::max(a[0], b[0]) && std::min(a[1], b[1]) <= p[1] &&
         p[1] <= std::max(a[1], b[1]);
}

/// Whether two lines have a point in common.
bool meet(const Point& a, const Point& b, const Point& c, const Point& d) {
  const double ca = cross(a, b, c), da = cross(a, b, d), ac = cross(c, d, a), bc = cross(c, d, b);
  if (((ca > 0.0) != (da > 0.0)) && ((ac > 0.0) != (bc > 0.0)) && ca != 0.0 && da != 0.0 && ac != 0.0 &&
      bc != 0.0)
    return true;
  return (ca == 0.0 && isBetween(a, b, c)) || (da == 0.0 && isBetween(a, b, d)) ||
         (ac == 0.0 && isBetween(c, d, a)) || (bc == 0.0 && isBetween(c, d, b));
}

bool crossesItself(const std::vector<Point>& outline) {
  const std::size_t n = outline.size();
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = i + 1; k < n; ++k) {
      const bool isNeighbour = k == i + 1 || (i == 0 && k == n - 1);
      const Point &a = outline[i], &b = outline[(i + 1) % n], &c = outline[k], &d = outline[(k + 1) % n];
      if (!isNeighbour) {
        if (meet(a, b, c, d)) return true;
        continue;
      }
      // Neighbours share a point; they cross where one runs back over the other.
      const Point &shared = k == i + 1 ? b : a, &before = k == i + 1 ? a : b, &after = k == i + 1 ? d : c;
      const double along =
          (before[0] - shared[0]) * (after[0] - shared[0]) + (before[1] - shared[1]) * (after[1] - shared[1]);
      if (n > 3 && cross(shared, before, after) == 0.0 && along > 0.0) return true;
    }
  return false;
}

double areaOf(const std::vector<Point>& outline) {
  double twice = 0.0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Point &a = outline[i], &b = outline[(i + 1) % outline.size()];
    twice += a[0] * b[1] - a[1] * b[0];
  }
  return 0.5 * std::abs(twice);
}

}  // namespace

Message outlineProblem(const Mask& mask) {
  for (const Point& point : mask.points)
    if (!std::isfinite(point[0]) || !std::isfinite(point[1]))
      return RELUCENT_MESSAGE("compensation.mask-not-finite", "its points must be finite numbers");
  if (mask.points.size() < 3)
    return RELUCENT_MESSAGE("compensation.mask-too-few-points", "its outline needs three points at least");
  if (mask.points.size() > mostMaskPoints)
    return RELUCENT_MESSAGE("compensation.mask-too-many-points", "its outline may have {} points at most")
        .with(mostMaskPoints);
  for (const Point& point : mask.points)
    if (std::min(point[0], point[1]) < 0.0 || std::max(point[0], point[1]) > 1.0)
      return RELUCENT_MESSAGE("compensation.mask-outside-view",
                              "its points must lie within the view, from 0 to 1 along both sides");
  for (std::size_t i = 0; i < mask.points.size(); ++i)
    if (distance(mask.points[i], mask.points[(i + 1) % mask.points.size()]) < leastDistance)
      return RELUCENT_MESSAGE("compensation.mask-point-twice", "two points of its outline are the same");
  const std::vector<Point> outline = outlineOf(mask);
  if (crossesItself(outline))
    return RELUCENT_MESSAGE("compensation.mask-crosses-itself", "its outline crosses itself");
  if (areaOf(outline) < leastArea)
    return RELUCENT_MESSAGE("compensation.mask-encloses-nothing", "its outline encloses nothing");
  return {};
}

std::vector<Message> problems(const std::vector<Mask>& masks) {
  std::vector<Message> found;
  for (std::size_t i = 0; i < masks.size(); ++i) {
    Message problem = outlineProblem(masks[i]);
    if (problem.empty() && !(masks[i].feather >= 0.0 && masks[i].feather <= widestFeather))
      problem = RELUCENT_MESSAGE("compensation.mask-feather-out-of-range",
                                 "its feather must lie between 0 and half of the view's larger side");
    if (!problem.empty())
      found.push_back(
          RELUCENT_MESSAGE("compensation.of-mask", "mask {}: {}").with(as::label(i + 1), problem));
  }
  return found;
}

std::vector<Point> outlineOf(const Mask& mask) {
  const std::size_t n = mask.points.size();
  require(n >= 3, "an outline of {} points", n);
  if (mask.outline == Outline::lines) return mask.points;
  std::vector<Point> outline;
  for (std::size_t i = 0; i < n; ++i)
    addPiece(mask.points[(i + n - 1) % n], mask.points[i], mask.points[(i + 1) % n], mask.points[(i + 2) % n],
             outline);
  return outline;
}

std::vector<float> sharesOf(const Mask& mask, Size view) {
  // Finer than the view's pixels, so that an outline is not jagged where it is not feathered.
  constexpr int fineEnough = 2048;
  const int side = std::max(view.width, view.height), finer = std::clamp(fineEnough / side, 1, 4);
  cv::Mat outside(finer * view.height, finer * view.width, CV_8U, cv::Scalar(255));
  constexpr int shift = 8;  // bits behind the point
  std::vector<cv::Point> polygon;
  for (const Point& point : outlineOf(mask))
    polygon.emplace_back(cvRound((point[0] * outside.cols - 0.5) * (1 << shift)),
                         cvRound((point[1] * outside.rows - 0.5) * (1 << shift)));
  cv::fillPoly(outside, std::vector<std::vector<cv::Point>>{polygon}, cv::Scalar(0), cv::LINE_8, shift);

  cv::Mat distance, shares;
  cv::distanceTransform(outside, distance, cv::DIST_L2, cv::DIST_MASK_PRECISE);
  const double feather = mask.feather * side * finer;
  distance.forEach<float>([feather](float& value, const int*) {
    // From the middle of the first pixel beyond the outline it is half a pixel.
    const double d = std::max(0.0, static_cast<double>(value) - 0.5);
    const double t = feather > 0.0 ? std::min(d / feather, 1.0) : (value > 0.0f ? 1.0 : 0.0);
    value = static_cast<float>(1.0 - t * t * (3.0 - 2.0 * t));
  });
  cv::resize(distance, shares, cv::Size(view.width, view.height), 0.0, 0.0, cv::INTER_AREA);
  return {shares.begin<float>(), shares.end<float>()};
}

}  // namespace relucent::compensation
