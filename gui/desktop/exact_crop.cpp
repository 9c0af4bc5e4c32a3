// SPDX-License-Identifier: MIT
#include "desktop/exact_crop.h"

#include <cmath>

namespace relucent::gui {
namespace {

bool explains(double scale, int pixels, int scaled) {
  return std::abs(pixels / scale - scaled) < 1.0;
}

/// A product such as 1.1 times 10 is 11, and not more.
constexpr double exact = 1e-9;

}  // namespace

std::optional<double> scaleOf(QSize mode, QSize logical) {
  if (mode.isEmpty() || logical.isEmpty()) return {};
  const double about = static_cast<double>(mode.width()) / logical.width();
  for (int denominator : {1, 2, 4, 5, 10, 20, 100, 120}) {
    const double scale = std::round(about * denominator) / denominator;
    if (scale > 0.0 && explains(scale, mode.width(), logical.width()) &&
        explains(scale, mode.height(), logical.height()))
      return scale;
  }
  return {};
}

std::optional<ExactCrop> exactCrop(QSize mode, QSize logical, QSize drawn) {
  const std::optional<double> scale = scaleOf(mode, logical);
  if (!scale) return {};
  auto place = [&](int length) { return static_cast<int>(std::ceil(length / *scale - exact)); };
  auto pixels = [&](int length) { return static_cast<int>(std::lround(length * *scale)); };
  ExactCrop crop;
  crop.place = {place(mode.width()), place(mode.height())};
  crop.pixels = {pixels(crop.place.width()), pixels(crop.place.height())};
  if (crop.pixels.width() > drawn.width() || crop.pixels.height() > drawn.height()) return {};
  return crop;
}

}  // namespace relucent::gui
