// SPDX-License-Identifier: MIT
#include "relucent/image/colour.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "relucent/base/error.h"
#include "relucent/base/parallel.h"
#include "relucent/image/mask.h"

namespace relucent::image {
namespace {

// Rows are X, Y, Z; their sums are the white that labFromXyz() divides by.
constexpr std::array<Colour, 3> xyzRows{
    {{0.4124, 0.3576, 0.1805}, {0.2126, 0.7152, 0.0722}, {0.0193, 0.1192, 0.9505}}};

double dot(const Colour& a, const Colour& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

double degrees(double radians) {
  return radians * (180.0 / std::numbers::pi);
}
double radians(double degrees) {
  return degrees * (std::numbers::pi / 180.0);
}

/// Hue angle in [0, 360); 0 for grey.
double hueOf(double a, double b) {
  if (a == 0.0 && b == 0.0) return 0.0;
  const double hue = degrees(std::atan2(b, a));
  return hue < 0.0 ? hue + 360.0 : hue;
}

double chromaWeight(double chroma) {
  const double seventh = std::pow(chroma, 7);
  return std::sqrt(seventh / (seventh + 6103515625.0));  // 25^7
}

template <typename Function>
Image eachMapped(const Image& image, const Function& function) {
  Image result(image.size(), image.channels());
  std::transform(image.data().begin(), image.data().end(), result.data().begin(),
                 [&](float value) { return static_cast<float>(function(static_cast<double>(value))); });
  return result;
}

Colour labOfEncoded(std::span<const float> pixel) {
  return labFromXyz(xyzFromLinearRgb({srgbDecode(pixel[0]), srgbDecode(pixel[1]), srgbDecode(pixel[2])}));
}

/// CIEDE2000 of the pixels that the mask selects, in their order.
std::vector<double> differencesInside(const Image& encodedA, const Image& encodedB,
                                      std::span<const std::uint8_t> mask) {
  const std::size_t counted = detail::comparedPixels(encodedA, encodedB, mask);
  require(encodedA.channels() == 3, "3 channels are needed, not {}", encodedA.channels());
  std::vector<std::size_t> pixels;
  pixels.reserve(counted);
  for (std::size_t i = 0; i < encodedA.pixels(); ++i)
    if (detail::inside(mask, i)) pixels.push_back(i);
  std::vector<double> difference(pixels.size());
  parallelFor(0, difference.size(), 1024, [&](std::size_t k) {
    difference[k] =
        ciede2000(labOfEncoded(encodedA.pixel(pixels[k])), labOfEncoded(encodedB.pixel(pixels[k])));
  });
  return difference;
}

}  // namespace

double srgbEncode(double linear) {
  const double size = std::abs(linear);
  const double encoded = size <= 0.0031308 ? 12.92 * size : 1.055 * std::pow(size, 1.0 / 2.4) - 0.055;
  return std::copysign(encoded, linear);
}

double srgbDecode(double encoded) {
  const double size = std::abs(encoded);
  const double linear = size <= 0.04045 ? size / 12.92 : std::pow((size + 0.055) / 1.055, 2.4);
  return std::copysign(linear, encoded);
}

Image srgbEncoded(const Image& linear) {
  return eachMapped(linear, srgbEncode);
}
Image srgbDecoded(const Image& encoded) {
  return eachMapped(encoded, srgbDecode);
}

double luminance(const Colour& linearRgb) {
  return dot(xyzRows[1], linearRgb);
}

Image luminance(const Image& linear) {
  require(linear.channels() == 3, "luminance needs 3 channels, not {}", linear.channels());
  Image result(linear.size(), 1);
  for (std::size_t i = 0; i < linear.pixels(); ++i) {
    const auto pixel = linear.pixel(i);
    result.data()[i] = static_cast<float>(luminance(Colour{pixel[0], pixel[1], pixel[2]}));
  }
  return result;
}

Colour xyzFromLinearRgb(const Colour& linearRgb) {
  return {dot(xyzRows[0], linearRgb), dot(xyzRows[1], linearRgb), dot(xyzRows[2], linearRgb)};
}

Colour labFromXyz(const Colour& xyz) {
  constexpr double edge = 6.0 / 29.0;
  auto f = [](double t) {
    return t > edge * edge * edge ? std::cbrt(t) : t / (3.0 * edge * edge) + 4.0 / 29.0;
  };
  const Colour white = xyzFromLinearRgb({1.0, 1.0, 1.0});
  const double x = f(xyz[0] / white[0]), y = f(xyz[1] / white[1]), z = f(xyz[2] / white[2]);
  return {116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)};
}

double ciede2000(const Colour& lab1, const Colour& lab2) {
  // Step 1: chroma with the a axis stretched near grey, and hue (equations 2 to 7).
  const double meanChroma = (std::hypot(lab1[1], lab1[2]) + std::hypot(lab2[1], lab2[2])) / 2.0;
  const double stretch = 1.0 + 0.5 * (1.0 - chromaWeight(meanChroma));
  const double a1 = stretch * lab1[1], a2 = stretch * lab2[1];
  const double chroma1 = std::hypot(a1, lab1[2]), chroma2 = std::hypot(a2, lab2[2]);
  const double hue1 = hueOf(a1, lab1[2]), hue2 = hueOf(a2, lab2[2]);
  const bool grey = chroma1 * chroma2 == 0.0;

  // Step 2: differences (equations 8 to 11); hue the short way round.
  const double lightnessStep = lab2[0] - lab1[0], chromaStep = chroma2 - chroma1;
  double hueAngle = grey ? 0.0 : hue2 - hue1;
  if (hueAngle > 180.0) hueAngle -= 360.0;
  if (hueAngle < -180.0) hueAngle += 360.0;
  const double hueStep = 2.0 * std::sqrt(chroma1 * chroma2) * std::sin(radians(hueAngle / 2.0));

  // Step 3: weights at the means (equations 12 to 21).
  const double lightness = (lab1[0] + lab2[0]) / 2.0, chroma = (chroma1 + chroma2) / 2.0;
  double hue = hue1 + hue2;
  if (!grey) {
    if (std::abs(hue1 - hue2) > 180.0) hue += hue < 360.0 ? 360.0 : -360.0;
    hue /= 2.0;
  }
  const double t = 1.0 - 0.17 * std::cos(radians(hue - 30.0)) + 0.24 * std::cos(radians(2.0 * hue)) +
                   0.32 * std::cos(radians(3.0 * hue + 6.0)) - 0.20 * std::cos(radians(4.0 * hue - 63.0));
  const double turn = 30.0 * std::exp(-std::pow((hue - 275.0) / 25.0, 2));
  const double offCentre = (lightness - 50.0) * (lightness - 50.0);
  const double lightnessTerm = lightnessStep / (1.0 + 0.015 * offCentre / std::sqrt(20.0 + offCentre));
  const double chromaTerm = chromaStep / (1.0 + 0.045 * chroma);
  const double hueTerm = hueStep / (1.0 + 0.015 * chroma * t);
  const double rotation = -std::sin(radians(2.0 * turn)) * 2.0 * chromaWeight(chroma);

  // Equation 22; rounding can push the sum of nearly equal colours just below 0.
  const double squared = lightnessTerm * lightnessTerm + chromaTerm * chromaTerm + hueTerm * hueTerm +
                         rotation * chromaTerm * hueTerm;
  return std::sqrt(std::max(squared, 0.0));
}

Image viewed(const Image& linear, const std::array<float, 3>& white) {
  require(linear.channels() == 3, "3 channels are needed, not {}", linear.channels());
  require(std::all_of(white.begin(), white.end(), [](float w) { return w > 0.0f; }),
          "white must be light, not {}, {}, {}", white[0], white[1], white[2]);
  Image result(linear.size(), 3);
  for (std::size_t i = 0; i < linear.data().size(); ++i) {
    const double share = static_cast<double>(linear.data()[i]) / static_cast<double>(white[i % 3]);
    result.data()[i] = static_cast<float>(srgbEncode(std::clamp(share, 0.0, 1.0)));
  }
  return result;
}

ColourDifference colourDifference(const Image& encodedA, const Image& encodedB,
                                  std::span<const std::uint8_t> mask) {
  std::vector<double> differences = differencesInside(encodedA, encodedB, mask);
  double sum = 0.0;
  for (double value : differences) sum += value;
  const auto rank = static_cast<std::ptrdiff_t>(0.95 * static_cast<double>(differences.size() - 1));
  std::nth_element(differences.begin(), differences.begin() + rank, differences.end());
  return {sum / static_cast<double>(differences.size()), differences[static_cast<std::size_t>(rank)]};
}

double meanDeltaE(const Image& encodedA, const Image& encodedB, std::span<const std::uint8_t> mask) {
  return colourDifference(encodedA, encodedB, mask).mean;
}

Image deltaEMap(const Image& encodedA, const Image& encodedB, std::span<const std::uint8_t> mask) {
  require(encodedA.size() == encodedB.size() && encodedA.channels() == 3 && encodedB.channels() == 3,
          "two images of one size and three channels are compared");
  require(mask.empty() || mask.size() == encodedA.pixels(), "a mask of {} values for {} pixels", mask.size(),
          encodedA.pixels());
  Image map(encodedA.size(), 1, std::numeric_limits<float>::quiet_NaN());
  parallelFor(0, map.pixels(), 1024, [&](std::size_t i) {
    if (detail::inside(mask, i))
      map.data()[i] =
          static_cast<float>(ciede2000(labOfEncoded(encodedA.pixel(i)), labOfEncoded(encodedB.pixel(i))));
  });
  return map;
}

}  // namespace relucent::image
