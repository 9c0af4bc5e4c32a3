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

constexpr Size usualSize{480, 360};

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

cv::Point at(const cv::Mat& picture, double u, double v) {
  return {static_cast<int>(u * picture.cols), static_cast<int>(v * picture.rows)};
}

/// Strokes as wide as `pixels` of the finished picture.
int strokes(double pixels) {
  return std::max(1, static_cast<int>(std::lround(pixels * oversampling)));
}

image::Image lineArt(Size size) {
  cv::Mat picture = canvas(size, {0.97, 0.97, 0.96});
  const cv::Scalar ink(0.05, 0.05, 0.07);
  // Circles around one point, further apart and thicker outwards.
  for (int ring = 1; ring <= 9; ++ring)
    cv::circle(picture, at(picture, 0.27, 0.45), static_cast<int>(0.0042 * ring * (ring + 3) * picture.rows),
               ink, strokes(0.5 + 0.25 * ring), cv::LINE_8);
  // A fan of rays that meet.
  for (int ray = 0; ray < 25; ++ray) {
    const double angle = std::numbers::pi * ray / 24.0;
    cv::line(picture, at(picture, 0.74, 0.52),
             at(picture, 0.74 + 0.22 * std::cos(angle), 0.52 - 0.42 * std::sin(angle)), ink, strokes(1.0));
  }
  // Hatching, once and crossed.
  for (int stroke = 0; stroke < 30; ++stroke) {
    const double u = 0.06 + 0.013 * stroke;
    cv::line(picture, at(picture, u, 0.95), at(picture, u + 0.06, 0.82), ink, strokes(1.0));
    if (stroke >= 15) cv::line(picture, at(picture, u, 0.82), at(picture, u + 0.06, 0.95), ink, strokes(1.0));
  }
  // Waves of falling length.
  cv::Point before = at(picture, 0.55, 0.8);
  for (int step = 1; step <= 400; ++step) {
    const double along = step / 400.0;
    cv::Point next = at(picture, 0.55 + 0.42 * along,
                        0.8 + 0.06 * std::sin(2.0 * std::numbers::pi * (3.0 * along + 6.0 * along * along)));
    cv::line(picture, before, next, ink, strokes(1.5));
    before = next;
  }
  return finished(picture, size);
}

image::Image filmStill(Size size) {
  cv::Mat picture = canvas(size, {0.0, 0.0, 0.0});
  const double columns = picture.cols, rows = picture.rows;
  const double half = 0.5 * columns / 2.39;  // of the wide frame's height
  picture.forEach<cv::Vec3f>([&](cv::Vec3f& pixel, const int* place) {
    const double y = place[0] - 0.5 * rows, u = place[1] / columns;
    if (std::abs(y) > half) return;
    const double v = y / half;  // -1 to 1
    // A dim blue room, a warm window from the right, a face that it lights from one side.
    const double room = 0.10 + 0.06 * (1.0 - v) + 0.05 * std::sin(9.0 * u);
    const double window = std::exp(-((u - 0.88) * (u - 0.88) / 0.02 + v * v / 0.5));
    const double du = (u - 0.4) / 0.085, dv = (v + 0.05) / 0.52, inFace = du * du + dv * dv;
    const double face = inFace < 1.0 ? std::sqrt(1.0 - inFace) : 0.0;
    const double lit = face * std::clamp(0.35 + 0.75 * du, 0.08, 1.0);
    const bool shoulders = v > 0.45 && std::abs(u - 0.4) < 0.09 + 0.16 * (v - 0.45);
    std::array<double, 3> colour{room * 0.75 + 0.75 * window, room * 0.95 + 0.62 * window,
                                 room * 1.3 + 0.42 * window};
    if (shoulders) colour = {0.16, 0.10, 0.09};
    if (face > 0.0) colour = {0.10 + 0.78 * lit, 0.08 + 0.58 * lit, 0.07 + 0.44 * lit};
    for (int c = 0; c < 3; ++c) pixel[c] = static_cast<float>(colour[static_cast<std::size_t>(c)]);
  });
  return finished(picture, size);
}

image::Image nightScene(Size size) {
  cv::Mat picture = canvas(size, {0.0, 0.0, 0.0});
  const double columns = picture.cols, rows = picture.rows;
  picture.forEach<cv::Vec3f>([&](cv::Vec3f& pixel, const int* place) {  // the sky above a ground
    const double v = place[0] / rows;
    const double glow = v < 0.68 ? 0.03 + 0.09 * v * v : 0.055 - 0.04 * (v - 0.68) / 0.32;
    pixel = cv::Vec3f(static_cast<float>(0.8 * glow), static_cast<float>(0.95 * glow),
                      static_cast<float>(1.5 * glow));
  });
  const std::array<double, 6> left{0.02, 0.17, 0.3, 0.5, 0.66, 0.85}, top{0.42, 0.3, 0.5, 0.36, 0.47, 0.4};
  for (std::size_t house = 0; house < left.size(); ++house) {
    const double right = left[house] + 0.125;
    cv::rectangle(picture, at(picture, left[house], top[house]), at(picture, right, 0.72),
                  cv::Scalar(0.035, 0.035, 0.05), cv::FILLED);
    for (int row = 0; row < 4; ++row)
      for (int column = 0; column < 4; ++column) {
        if ((7 * row + 3 * column + 5 * static_cast<int>(house)) % 4 != 0) continue;  // somebody is up
        const double u = left[house] + 0.014 + 0.028 * column, v = top[house] + 0.03 + 0.055 * row;
        if (v > 0.66) continue;
        cv::rectangle(picture, at(picture, u, v), at(picture, u + 0.014, v + 0.03),
                      row % 2 == 0 ? cv::Scalar(0.42, 0.33, 0.16) : cv::Scalar(0.2, 0.22, 0.25), cv::FILLED);
      }
  }
  for (double u : {0.15, 0.48, 0.81}) {  // lamps, and their light on the ground
    cv::line(picture, at(picture, u, 0.6), at(picture, u, 0.8), cv::Scalar(0.08, 0.08, 0.08), strokes(2.0));
    cv::ellipse(picture, at(picture, u, 0.82),
                {static_cast<int>(0.07 * columns), static_cast<int>(0.025 * rows)}, 0.0, 0.0, 360.0,
                cv::Scalar(0.16, 0.13, 0.08), cv::FILLED);
    cv::circle(picture, at(picture, u, 0.59), static_cast<int>(0.018 * rows), cv::Scalar(1.0, 0.93, 0.75),
               cv::FILLED);
  }
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

std::vector<NamedImage> judgedImages(Size size) {
  std::vector<NamedImage> images = standardImages(size);
  images.push_back({"line-art", lineArt(size)});
  images.push_back({"film", filmStill(size)});
  images.push_back({"dark", nightScene(size)});
  return images;
}

const std::vector<NamedImage>& judgedImages() {
  static const std::vector<NamedImage> drawn = judgedImages(usualSize);
  return drawn;
}

const std::vector<NamedImage>& standardImages() {
  static const std::vector<NamedImage> drawn = standardImages(usualSize);
  return drawn;
}

}  // namespace relucent::pipeline
