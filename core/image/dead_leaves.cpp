// SPDX-License-Identifier: MIT
#include "relucent/image/dead_leaves.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "relucent/base/error.h"
#include "relucent/base/random.h"
#include "relucent/image/drawing.h"

namespace relucent::image {

using namespace drawing;

Image deadLeaves(Size size, std::uint64_t seed) {
  require(size.width >= 8 && size.height >= 8, "no picture can be drawn in {}x{} pixels", size.width,
          size.height);
  cv::Mat picture = canvas(size, {0.5, 0.5, 0.5});
  Random random{seed};
  double largest = 0.3 * picture.rows;
  double smallest = 0.004 * picture.rows;
  // From the bottom up; enough discs that the whole picture is covered many times over.
  constexpr int discs = 9000;
  for (int i = 0; i < discs; ++i) {
    // Inverse of the cumulative distribution of a density falling as r^-3 between the two radii.
    double u = random.uniform();
    double a = 1.0 / (smallest * smallest);
    double b = 1.0 / (largest * largest);
    double radius = 1.0 / std::sqrt(a + u * (b - a));
    // One after the other: compilers evaluate the arguments of a call in an order of their own.
    const auto y = static_cast<int>(random.below(static_cast<std::uint64_t>(picture.rows)));
    const auto x = static_cast<int>(random.below(static_cast<std::uint64_t>(picture.cols)));
    const cv::Point centre(x, y);
    double hue = random.uniform();
    double saturation = 0.5 * random.uniform();
    double value = 0.15 + 0.8 * random.uniform();
    cv::circle(picture, centre, std::max(1, static_cast<int>(radius)), hsv(hue, saturation, value),
               cv::FILLED);
  }
  return finished(picture, size);
}

}  // namespace relucent::image
