// SPDX-License-Identifier: MIT
#include "relucent/image/metrics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <utility>
#include <vector>

#include "relucent/base/error.h"
#include "relucent/image/colour.h"
#include "relucent/image/mask.h"

namespace relucent::image {
namespace {

constexpr int windowRadius = 5;

/// Mean over pixels of sum over channels ((a - b) / scale)^2 / channels.
template <typename Scale>
double meanSquare(const Image& a, const Image& b, std::span<const std::uint8_t> mask, const Scale& scale) {
  const std::size_t counted = detail::comparedPixels(a, b, mask);
  double sum = 0.0;
  for (std::size_t i = 0; i < a.pixels(); ++i) {
    if (!detail::inside(mask, i)) continue;
    const auto pixelA = a.pixel(i), pixelB = b.pixel(i);
    for (std::size_t c = 0; c < pixelA.size(); ++c) {
      const double step = (static_cast<double>(pixelA[c]) - static_cast<double>(pixelB[c])) / scale(c);
      sum += step * step;
    }
  }
  return sum / (static_cast<double>(counted) * a.channels());
}

double decibels(double meanSquare) {
  return meanSquare > 0.0 ? -10.0 * std::log10(meanSquare) : std::numeric_limits<double>::infinity();
}

/// The luma as doubles: variances are differences of nearly equal numbers.
cv::Mat lumaOf(const Image& encoded) {
  cv::Mat luma(encoded.height(), encoded.width(), CV_64F);
  for (std::size_t i = 0; i < encoded.pixels(); ++i) {
    const auto pixel = encoded.pixel(i);
    luma.ptr<double>()[i] =
        encoded.channels() == 3 ? luminance(Colour{pixel[0], pixel[1], pixel[2]}) : pixel[0];
  }
  return luma;
}

cv::Mat windowMean(const cv::Mat& values) {
  cv::Mat mean;
  const int side = 2 * windowRadius + 1;
  cv::GaussianBlur(values, mean, cv::Size(side, side), 1.5, 1.5, cv::BORDER_REFLECT_101);
  return mean;
}

/// Per pixel: the whole similarity, and what of it is contrast and structure.
struct Similarity {
  cv::Mat whole, structure;
};

/// Wang et al., equation 13.
Similarity similarityMap(const cv::Mat& a, const cv::Mat& b) {
  constexpr double c1 = 0.01 * 0.01, c2 = 0.03 * 0.03;
  const cv::Mat meanA = windowMean(a), meanB = windowMean(b);
  const cv::Mat meanAA = meanA.mul(meanA), meanBB = meanB.mul(meanB), meanAB = meanA.mul(meanB);
  const cv::Mat varianceA = windowMean(a.mul(a)) - meanAA, varianceB = windowMean(b.mul(b)) - meanBB;
  const cv::Mat covariance = windowMean(a.mul(b)) - meanAB;
  const cv::Mat structureAbove = 2.0 * covariance + c2, structureBelow = varianceA + varianceB + c2;
  const cv::Mat above = (2.0 * meanAB + c1).mul(structureAbove);
  const cv::Mat below = (meanAA + meanBB + c1).mul(structureBelow);
  return {above / below, structureAbove / structureBelow};
}

/// Mean over the windows whose centres the mask selects; those that extend beyond the image count only if
/// there are no others.
double meanOfWindows(const cv::Mat& map, std::span<const std::uint8_t> mask) {
  double wholeSum = 0.0, edgeSum = 0.0;
  std::size_t wholeCount = 0, edgeCount = 0;
  for (int y = 0; y < map.rows; ++y)
    for (int x = 0; x < map.cols; ++x) {
      if (!detail::inside(mask, indexOf({map.cols, map.rows}, {x, y}))) continue;
      const bool whole = x >= windowRadius && y >= windowRadius && x < map.cols - windowRadius &&
                         y < map.rows - windowRadius;
      (whole ? wholeSum : edgeSum) += map.at<double>(y, x);
      ++(whole ? wholeCount : edgeCount);
    }
  return wholeCount > 0 ? wholeSum / static_cast<double>(wholeCount)
                        : edgeSum / static_cast<double>(edgeCount);
}

void checkEncoded(const Image& a, const Image& b, std::span<const std::uint8_t> mask) {
  detail::comparedPixels(a, b, mask);
  require(a.channels() == 3 || a.channels() == 1, "no luma of {} channels", a.channels());
}

/// Means of 2x2 pixels; an odd row or column at the end has none.
cv::Mat halved(const cv::Mat& values) {
  cv::Mat half(values.rows / 2, values.cols / 2, CV_64F);
  for (int y = 0; y < half.rows; ++y)
    for (int x = 0; x < half.cols; ++x)
      half.at<double>(y, x) =
          0.25 * (values.at<double>(2 * y, 2 * x) + values.at<double>(2 * y, 2 * x + 1) +
                  values.at<double>(2 * y + 1, 2 * x) + values.at<double>(2 * y + 1, 2 * x + 1));
  return half;
}

/// Selected where all four pixels are.
std::vector<std::uint8_t> halvedMask(const std::vector<std::uint8_t>& mask, Size size) {
  const Size half{size.width / 2, size.height / 2};
  std::vector<std::uint8_t> result(half.count());
  for (int y = 0; y < half.height; ++y)
    for (int x = 0; x < half.width; ++x)
      result[indexOf(half, {x, y})] =
          mask[indexOf(size, {2 * x, 2 * y})] && mask[indexOf(size, {2 * x + 1, 2 * y})] &&
          mask[indexOf(size, {2 * x, 2 * y + 1})] && mask[indexOf(size, {2 * x + 1, 2 * y + 1})];
  return result;
}

/// At least one window lies inside, with its centre in the mask.
bool holdsWindow(const std::vector<std::uint8_t>& mask, Size size) {
  for (int y = windowRadius; y < size.height - windowRadius; ++y)
    for (int x = windowRadius; x < size.width - windowRadius; ++x)
      if (mask[indexOf(size, {x, y})]) return true;
  return false;
}

}  // namespace

double mse(const Image& a, const Image& b, std::span<const std::uint8_t> mask) {
  return meanSquare(a, b, mask, [](std::size_t) { return 1.0; });
}

double psnr(const Image& a, const Image& b, double peak, std::span<const std::uint8_t> mask) {
  require(peak > 0.0, "a peak is positive, not {}", peak);
  return decibels(meanSquare(a, b, mask, [&](std::size_t) { return peak; }));
}

double psnr(const Image& a, const Image& b, const std::array<float, 3>& white,
            std::span<const std::uint8_t> mask) {
  require(a.channels() == 3, "3 channels are needed, not {}", a.channels());
  for (float peak : white) require(peak > 0.0f, "a peak is positive, not {}", peak);
  return decibels(meanSquare(a, b, mask, [&](std::size_t c) { return static_cast<double>(white[c]); }));
}

double ssim(const Image& encodedA, const Image& encodedB, std::span<const std::uint8_t> mask) {
  checkEncoded(encodedA, encodedB, mask);
  return meanOfWindows(similarityMap(lumaOf(encodedA), lumaOf(encodedB)).whole, mask);
}

double multiScaleSsim(const Image& encodedA, const Image& encodedB, std::span<const std::uint8_t> mask) {
  constexpr std::array exponents{0.0448, 0.2856, 0.3001, 0.2363, 0.1333};
  checkEncoded(encodedA, encodedB, mask);
  cv::Mat a = lumaOf(encodedA), b = lumaOf(encodedB);
  Size size = encodedA.size();
  std::vector<std::uint8_t> selected(mask.begin(), mask.end());
  if (mask.empty()) selected.assign(size.count(), 1);

  double logarithm = 0.0, exponentsSoFar = 0.0;
  for (std::size_t scale = 0;; ++scale) {
    const Similarity similarity = similarityMap(a, b);
    const Size half{size.width / 2, size.height / 2};
    std::vector<std::uint8_t> next = halvedMask(selected, size);
    const bool last = scale + 1 == exponents.size() || !holdsWindow(next, half);
    const double mean = meanOfWindows(last ? similarity.whole : similarity.structure, selected);
    logarithm += exponents[scale] * std::log(std::max(mean, 0.0));
    exponentsSoFar += exponents[scale];
    if (last) return std::exp(logarithm / exponentsSoFar);
    a = halved(a);
    b = halved(b);
    size = half;
    selected = std::move(next);
  }
}

}  // namespace relucent::image
