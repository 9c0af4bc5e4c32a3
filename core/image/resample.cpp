// SPDX-License-Identifier: MIT
#include "relucent/image/resample.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "relucent/base/error.h"
#include "relucent/base/parallel.h"
#include "relucent/image/opencv_memory.h"

namespace relucent::image {
namespace {

constexpr int mostSamplesPerAxis = 8;

cv::Mat matOf(const Image& image) {
  return cv::Mat(image.height(), image.width(), CV_32FC(image.channels()),
                 const_cast<float*>(image.data().data()));
}

/// Area averaging only makes sense for shrinking, bilinear only for enlarging.
cv::Mat scaledAxis(const cv::Mat& image, cv::Size size) {
  if (size == image.size()) return image;
  cv::Mat scaled;
  const bool shrinks = size.width < image.cols || size.height < image.rows;
  cv::resize(image, scaled, size, 0.0, 0.0, shrinks ? cv::INTER_AREA : cv::INTER_LINEAR);
  return scaled;
}

std::array<cv::Point2f, 4> cvPoints(const std::array<Point, 4>& points) {
  std::array<cv::Point2f, 4> result;
  std::transform(points.begin(), points.end(), result.begin(), [](const Point& p) {
    return cv::Point2f(static_cast<float>(p[0]), static_cast<float>(p[1]));
  });
  return result;
}

bool threeCollinear(const std::array<Point, 4>& points) {
  for (std::size_t left = 0; left < 4; ++left) {
    const Point &a = points[(left + 1) % 4], &b = points[(left + 2) % 4], &c = points[(left + 3) % 4];
    const double area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    const double scale = std::hypot(b[0] - a[0], b[1] - a[1]) * std::hypot(c[0] - a[0], c[1] - a[1]);
    if (!(std::abs(area) > 1e-6 * scale)) return true;  // float coordinates cannot tell less from a line
  }
  return false;
}

double depthAt(const Homography& map, Point point) {
  return map[6] * point[0] + map[7] * point[1] + map[8];
}

/// How many source pixels a step of one result pixel covers at most, around `point`.
double stretchAt(const Homography& map, Point point) {
  const Point here = mapped(map, point);
  const Point right = mapped(map, {point[0] + 1.0, point[1]}),
              below = mapped(map, {point[0], point[1] + 1.0});
  return std::max(std::hypot(right[0] - here[0], right[1] - here[1]),
                  std::hypot(below[0] - here[0], below[1] - here[1]));
}

int samplesPerAxis(const Homography& map, Point centre) {
  const double stretch = stretchAt(map, centre);
  if (!std::isfinite(stretch)) return 1;
  return static_cast<int>(std::clamp(std::ceil(stretch - 1e-9), 1.0, double{mostSamplesPerAxis}));
}

/// Adds the bilinear value at `point` to `sum`; edges are replicated within the outermost half pixel.
/// False, if the point is outside.
bool addBilinear(const Image& image, Point point, std::span<double> sum) {
  if (!(point[0] >= 0.0 && point[1] >= 0.0 && point[0] <= image.width() && point[1] <= image.height()))
    return false;
  const double x = std::clamp(point[0] - 0.5, 0.0, image.width() - 1.0);
  const double y = std::clamp(point[1] - 0.5, 0.0, image.height() - 1.0);
  const int x0 = static_cast<int>(x), y0 = static_cast<int>(y);
  const int x1 = std::min(x0 + 1, image.width() - 1), y1 = std::min(y0 + 1, image.height() - 1);
  const double fx = x - x0, fy = y - y0;
  for (std::size_t channel = 0; channel < sum.size(); ++channel) {
    const int c = static_cast<int>(channel);
    sum[channel] += (1.0 - fy) * ((1.0 - fx) * image.at(x0, y0, c) + fx * image.at(x1, y0, c)) +
                    fy * ((1.0 - fx) * image.at(x0, y1, c) + fx * image.at(x1, y1, c));
  }
  return true;
}

}  // namespace

Homography homographyBetween(const std::array<Point, 4>& from, const std::array<Point, 4>& to) {
  if (threeCollinear(from) || threeCollinear(to))
    throw Error(
        ErrorKind::input,
        RELUCENT_ENGLISH_MESSAGE("image.corners-collinear", "three of the four corners lie on a line"),
        RELUCENT_ENGLISH_MESSAGE("image.move-corners-apart",
                                 "move the corners apart so that they form a quadrilateral"));
  const cv::Mat map = cv::getPerspectiveTransform(cvPoints(from).data(), cvPoints(to).data());
  Homography result;
  std::copy(map.ptr<double>(), map.ptr<double>() + 9, result.begin());
  const Point middle{(from[0][0] + from[1][0] + from[2][0] + from[3][0]) / 4.0,
                     (from[0][1] + from[1][1] + from[2][1] + from[3][1]) / 4.0};
  if (depthAt(result, middle) < 0.0)
    for (double& value : result) value = -value;
  return result;
}

Homography homographyFromCorners(Size image, const std::array<Point, 4>& corners) {
  const double width = image.width, height = image.height;
  return homographyBetween({{{0.0, 0.0}, {width, 0.0}, {width, height}, {0.0, height}}}, corners);
}

Homography inverted(const Homography& map) {
  const cv::Matx33d inverse = cv::Matx33d(map.data()).inv();
  Homography result;
  std::copy(inverse.val, inverse.val + 9, result.begin());
  if (std::all_of(result.begin(), result.end(), [](double v) { return v == 0.0; }))
    throw Error(ErrorKind::input,
                RELUCENT_ENGLISH_MESSAGE("image.perspective-singular", "the perspective map has no inverse"),
                RELUCENT_ENGLISH_MESSAGE("image.move-corners-apart",
                                         "move the corners apart so that they form a quadrilateral"));
  return result;
}

Point mapped(const Homography& map, Point point) {
  const double w = depthAt(map, point);
  return {(map[0] * point[0] + map[1] * point[1] + map[2]) / w,
          (map[3] * point[0] + map[4] * point[1] + map[5]) / w};
}

Image resized(const Image& image, Size size) {
  require(!image.empty() && !size.empty(), "{}x{} pixels cannot become {}x{}", image.width(), image.height(),
          size.width, size.height);
  const cv::Mat result = withinMemory([&] {
    const cv::Mat wide = scaledAxis(matOf(image), cv::Size(size.width, image.height()));
    return scaledAxis(wide, cv::Size(size.width, size.height));
  });
  const float* begin = result.ptr<float>();
  return Image(size, image.channels(),
               std::vector<float>(begin, begin + size.count() * static_cast<std::size_t>(image.channels())));
}

Image warpedPerspective(const Image& source, const Homography& sourceFromResult, Size size, float outside) {
  require(!source.empty(), "an empty image cannot be warped");
  Image result(size, source.channels());
  parallelFor(0, size.count(), 4096, [&](std::size_t index) {
    const Pixel pixel = pixelAt(size, index);
    const int samples = samplesPerAxis(sourceFromResult, {pixel.x + 0.5, pixel.y + 0.5});
    std::vector<double> sum(static_cast<std::size_t>(source.channels()));
    int missed = 0;
    for (int j = 0; j < samples; ++j)
      for (int i = 0; i < samples; ++i) {
        const Point at{pixel.x + (i + 0.5) / samples, pixel.y + (j + 0.5) / samples};
        const bool inFront = depthAt(sourceFromResult, at) > 0.0;
        if (!inFront || !addBilinear(source, mapped(sourceFromResult, at), sum)) ++missed;
      }
    for (std::size_t c = 0; c < sum.size(); ++c)
      result.pixel(index)[c] = static_cast<float>((sum[c] + missed * double{outside}) / (samples * samples));
  });
  return result;
}

}  // namespace relucent::image
