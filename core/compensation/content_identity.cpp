// SPDX-License-Identifier: MIT
#include "relucent/compensation/content_identity.h"

#include <algorithm>
#include <cmath>

#include "relucent/base/fingerprint.h"
#include "relucent/base/require.h"
#include "relucent/image/resample.h"

namespace relucent::compensation {
namespace {

double aspectOf(Size size) {
  return static_cast<double>(size.width) / size.height;
}

bool hasOwnShape(Size picture, const ContentCanvas& canvas) {
  constexpr double alike = 1e-3;  // a pixel of a thousand
  return canvas.size.count() > 0 && std::abs(aspectOf(canvas.size) / aspectOf(picture) - 1.0) > alike;
}

/// The picture's size on the canvas: bars beside it, or more than fits.
Size scaledSize(Size picture, const ContentCanvas& canvas) {
  if (canvas.fit == Fit::fill) return canvas.size;
  const double wide = static_cast<double>(canvas.size.width) / picture.width;
  const double high = static_cast<double>(canvas.size.height) / picture.height;
  const double scale = canvas.fit == Fit::fit ? std::min(wide, high) : std::max(wide, high);
  return {std::max(1, static_cast<int>(std::lround(scale * picture.width))),
          std::max(1, static_cast<int>(std::lround(scale * picture.height)))};
}

}  // namespace

std::vector<Message> problems(const ContentCanvas& canvas) {
  const auto isSide = [](int pixels) { return pixels >= leastCanvasSide && pixels <= mostCanvasSide; };
  if (canvas.size == Size{} || (isSide(canvas.size.width) && isSide(canvas.size.height))) return {};
  return {RELUCENT_ENGLISH_MESSAGE("content.canvas-out-of-range",
                                   "a canvas of {} pixels is impossible: each side is {} to {}")
              .with(as::size(canvas.size), leastCanvasSide, mostCanvasSide)};
}

std::string contentIdentity(std::string_view file, Size picture, const ContentCanvas& canvas) {
  Fingerprint fingerprint;
  fingerprint.add(file);
  if (hasOwnShape(picture, canvas))
    fingerprint.add(fmt::format("{:.3f} {}", aspectOf(canvas.size), nameOf(canvas.fit)));
  return fingerprint.hex();
}

image::Image onCanvas(const image::Image& picture, const ContentCanvas& canvas) {
  require(!picture.empty() && picture.channels() == 3, "a picture of {} channels", picture.channels());
  if (canvas.size.count() == 0 || canvas.size == picture.size()) return picture;
  const Size scaled = scaledSize(picture.size(), canvas);
  image::Image whole = image::resized(picture, scaled);
  if (scaled == canvas.size) return whole;
  const int left = (canvas.size.width - scaled.width) / 2, top = (canvas.size.height - scaled.height) / 2;
  image::Image result(canvas.size, 3);
  for (int y = std::max(0, top); y < std::min(canvas.size.height, top + scaled.height); ++y)
    for (int x = std::max(0, left); x < std::min(canvas.size.width, left + scaled.width); ++x)
      for (int c = 0; c < 3; ++c) result.at(x, y, c) = whole.at(x - left, y - top, c);
  return result;
}

}  // namespace relucent::compensation
