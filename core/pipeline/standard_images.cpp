// SPDX-License-Identifier: MIT
#include "relucent/pipeline/standard_images.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "relucent/base/error.h"
#include "relucent/image/dead_leaves.h"
#include "relucent/image/drawing.h"

namespace relucent::pipeline {
namespace {

using namespace image::drawing;

image::Image lettering(Size size) {
  cv::Mat picture = canvas(size, {0.92, 0.92, 0.9});
  int half = picture.rows / 2;
  cv::rectangle(picture, cv::Rect(0, half, picture.cols, picture.rows - half), cv::Scalar(0.08, 0.09, 0.12),
                cv::FILLED);
  const std::array<const char*, 4> lines{"Light transport", "Every wall becomes a white screen",
                                         "0123456789 ABCDEFGHIJKLM abcdefghijklm",
                                         "projector camera radiance floodlight reachability exposure"};
  const std::array<double, 4> heights{0.13, 0.075, 0.05, 0.035};  // of the picture
  for (int part = 0; part < 2; ++part) {
    cv::Scalar ink = part == 0 ? cv::Scalar(0.06, 0.06, 0.08) : cv::Scalar(0.95, 0.93, 0.85);
    double y = part * half;
    for (std::size_t i = 0; i < lines.size(); ++i) {
      double height = heights[i] * picture.rows;
      y += height * 1.1;
      // A glyph of this face is 22 units high at scale 1.
      cv::putText(picture, lines[i], cv::Point(picture.cols / 40, static_cast<int>(y)),
                  cv::FONT_HERSHEY_DUPLEX, height / 32.0, ink, std::max(1, static_cast<int>(height / 11)),
                  cv::LINE_AA);
    }
    // Gratings under the lettering, periods from 2 to 12 pixels of the finished picture.
    int top = static_cast<int>(y + 0.02 * picture.rows);
    int bottom = part * half + half - picture.rows / 60;
    int x = picture.cols / 40;
    for (int period : {12, 8, 6, 4, 3, 2}) {
      for (int bar = 0; bar < 5; ++bar) {
        int width = period * oversampling / 2;
        cv::rectangle(picture, cv::Rect(x, top, width, std::max(1, bottom - top)), ink, cv::FILLED);
        x += 2 * width;
      }
      x += picture.cols / 30;
    }
  }
  return finished(picture, size);
}

image::Image saturatedColours(Size size) {
  cv::Mat picture = canvas(size, {0.5, 0.5, 0.5});
  double columns = picture.cols;
  double rows = picture.rows;
  picture.forEach<cv::Vec3f>([&](cv::Vec3f& pixel, const int* place) {
    double v = place[0] / rows;
    double u = place[1] / columns;
    cv::Scalar colour;
    if (v < 0.35)  // all hues, fading to white
      colour = hsv(u, 1.0 - v / 0.35 * 0.8, 0.95);
    else if (v < 0.65)  // bars with hard borders
      colour = hsv(std::floor(u * 8.0) / 8.0, 0.95, 0.9);
    else  // discs of a hue on its complement
      colour = hsv(std::floor(u * 4.0) / 4.0 + 0.5, 0.8, 0.45);
    pixel = cv::Vec3f(static_cast<float>(colour[0]), static_cast<float>(colour[1]),
                      static_cast<float>(colour[2]));
  });
  for (int i = 0; i < 4; ++i)
    cv::circle(picture, cv::Point(static_cast<int>((i + 0.5) * columns / 4), static_cast<int>(0.825 * rows)),
               static_cast<int>(0.12 * rows), hsv(i / 4.0, 0.9, 0.95), cv::FILLED, cv::LINE_8);
  return finished(picture, size);
}

}  // namespace

std::vector<NamedImage> standardImages(Size size) {
  require(size.width >= 8 && size.height >= 8, "no picture can be drawn in {}x{} pixels", size.width,
          size.height);
  return {{"natural", image::deadLeaves(size, 20071028)},
          {"text", lettering(size)},
          {"colours", saturatedColours(size)}};
}

}  // namespace relucent::pipeline
