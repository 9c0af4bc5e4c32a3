// SPDX-License-Identifier: MIT
#include "relucent/image/photograph_check.h"

#include <algorithm>
#include <cmath>

#include "relucent/base/error.h"
#include "relucent/image/colour.h"

namespace relucent::image {

PhotographCheck checkPhotograph(const Image& signal, double saturation, double dark) {
  require(signal.channels() == 3, "a photograph has three channels, not {}", signal.channels());
  PhotographCheck check;
  check.exposed.assign(signal.pixels(), Exposed::well);
  std::size_t bright = 0, faint = 0;
  for (std::size_t i = 0; i < signal.pixels(); ++i) {
    bool tooBright = false, tooDark = true;
    for (std::size_t c = 0; c < 3; ++c) {
      double value = static_cast<double>(signal.pixel(i)[c]);
      if (!std::isfinite(value)) continue;
      double bin = std::clamp(value, 0.0, 1.0) * static_cast<double>(PhotographCheck::bins);
      ++check.histogram[c][std::min(static_cast<std::size_t>(bin), PhotographCheck::bins - 1)];
      tooBright = tooBright || value >= saturation;
      tooDark = tooDark && value < dark;
    }
    if (tooBright) {
      check.exposed[i] = Exposed::tooBright;
      ++bright;
    } else if (tooDark) {
      check.exposed[i] = Exposed::tooDark;
      ++faint;
    }
  }
  if (signal.pixels() > 0) {
    check.tooBright = static_cast<double>(bright) / static_cast<double>(signal.pixels());
    check.tooDark = static_cast<double>(faint) / static_cast<double>(signal.pixels());
  }
  return check;
}

double tooBrightWithin(const PhotographCheck& check, Size size, const Region& region) {
  require(check.exposed.size() == size.count(), "a check of {} pixels is not of {}", check.exposed.size(),
          size.count());
  std::size_t bright = 0, all = 0;
  for (int y = std::max(0, region.y); y < std::min(size.height, region.y + region.height); ++y)
    for (int x = std::max(0, region.x); x < std::min(size.width, region.x + region.width); ++x, ++all)
      if (check.exposed[indexOf(size, {x, y})] == Exposed::tooBright) ++bright;
  return all > 0 ? static_cast<double>(bright) / static_cast<double>(all) : 0.0;
}

double sharpness(const Image& signal, const Region& region) {
  require(signal.channels() == 3, "a photograph has three channels, not {}", signal.channels());
  int left = std::clamp(region.x, 0, signal.width()), top = std::clamp(region.y, 0, signal.height());
  int right = std::clamp(region.x + region.width, left, signal.width());
  int bottom = std::clamp(region.y + region.height, top, signal.height());
  Image brightness = luminance(signal);
  double differences = 0.0, squares = 0.0;
  std::size_t pairs = 0, pixels = 0;
  auto add = [&](float difference) {
    differences += static_cast<double>(difference) * static_cast<double>(difference);
    ++pairs;
  };
  for (int y = top; y < bottom; ++y)
    for (int x = left; x < right; ++x) {
      float here = brightness.at(x, y, 0);
      squares += static_cast<double>(here) * static_cast<double>(here);
      ++pixels;
      if (x + 1 < right) add(brightness.at(x + 1, y, 0) - here);
      if (y + 1 < bottom) add(brightness.at(x, y + 1, 0) - here);
    }
  if (pairs == 0 || !(squares > 0.0)) return 0.0;
  return (differences / static_cast<double>(pairs)) / (squares / static_cast<double>(pixels));
}

std::vector<std::uint8_t> focusPeaks(const Image& signal, double limit, double dark) {
  require(signal.channels() == 3, "a photograph has three channels, not {}", signal.channels());
  const Image brightness = luminance(signal);
  const Size size = signal.size();
  std::vector<std::uint8_t> peaks(size.count(), 0);
  for (int y = 0; y + 1 < size.height; ++y)
    for (int x = 0; x + 1 < size.width; ++x) {
      const auto here = static_cast<double>(brightness.at(x, y, 0));
      const double across = static_cast<double>(brightness.at(x + 1, y, 0)) - here,
                   down = static_cast<double>(brightness.at(x, y + 1, 0)) - here;
      const bool isSharp = std::hypot(across, down) > limit * here;
      if (here > dark && isSharp) peaks[indexOf(size, {x, y})] = 1;
    }
  return peaks;
}

}  // namespace relucent::image
