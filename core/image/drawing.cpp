// SPDX-License-Identifier: MIT
#include "relucent/image/drawing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "relucent/image/colour.h"
#include "relucent/image/opencv_memory.h"

namespace relucent::image::drawing {

cv::Mat canvas(Size size, const cv::Scalar& encoded) {
  return withinMemory(
      [&] { return cv::Mat(size.height * oversampling, size.width * oversampling, CV_32FC3, encoded); });
}

Image finished(const cv::Mat& encoded, Size size) {
  cv::Mat linear = withinMemory([&] { return encoded.clone(); });
  linear.forEach<cv::Vec3f>([](cv::Vec3f& pixel, const int*) {
    for (int c = 0; c < 3; ++c) pixel[c] = static_cast<float>(srgbDecode(std::clamp(pixel[c], 0.0f, 1.0f)));
  });
  const cv::Mat small = withinMemory([&] {
    cv::Mat means;
    cv::resize(linear, means, cv::Size(size.width, size.height), 0, 0, cv::INTER_AREA);
    return means;
  });
  return Image(size, 3, std::vector<float>(small.ptr<float>(), small.ptr<float>() + size.count() * 3));
}

cv::Scalar hsv(double hue, double saturation, double value) {
  std::array<double, 3> rgb{};
  for (int c = 0; c < 3; ++c) {
    double distance = std::abs(std::remainder(hue - c / 3.0, 1.0)) * 6.0;
    double pure = std::clamp(2.0 - distance, 0.0, 1.0);
    rgb[static_cast<std::size_t>(c)] = value * (1.0 - saturation * (1.0 - pure));
  }
  return {rgb[0], rgb[1], rgb[2]};
}

}  // namespace relucent::image::drawing
