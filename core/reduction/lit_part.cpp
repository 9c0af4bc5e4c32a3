// SPDX-License-Identifier: MIT
#include "relucent/reduction/lit_part.h"

#include <algorithm>
#include <numeric>
#include <ranges>
#include <utility>
#include <vector>

#include "relucent/base/error.h"
#include "relucent/base/parallel.h"

namespace relucent::reduction {
namespace {

constexpr double noiseQuantile = 0.999;
constexpr double scattered = 0.05;  // of the typical brightness
constexpr double direct = 0.15;     // of it as well
constexpr double stray = 0.0005;    // of the lit light, on each side
constexpr int surroundings = 16;    // the share of a side that is added: one over this

/// The mean over channels and over the pixel and its neighbours.
std::vector<float> brightnessOf(const image::Image& light) {
  std::vector<float> brightness(light.pixels());
  parallelFor(0, static_cast<std::size_t>(light.height()), 16, [&](std::size_t row) {
    const int y = static_cast<int>(row);
    const int top = std::max(0, y - 1), bottom = std::min(light.height() - 1, y + 1);
    for (int x = 0; x < light.width(); ++x) {
      const int left = std::max(0, x - 1), right = std::min(light.width() - 1, x + 1);
      float sum = 0.0f;
      for (int v = top; v <= bottom; ++v)
        for (int u = left; u <= right; ++u)
          for (int c = 0; c < 3; ++c) sum += light.at(u, v, c);
      brightness[indexOf(light.size(), {x, y})] =
          sum / static_cast<float>(3 * (right - left + 1) * (bottom - top + 1));
    }
  });
  return brightness;
}

/// No light is below zero: what is there is noise.
double noiseOf(std::vector<float> brightness) {
  auto place = brightness.begin() + static_cast<std::ptrdiff_t>((1.0 - noiseQuantile) *
                                                                static_cast<double>(brightness.size() - 1));
  std::ranges::nth_element(brightness, place);
  return std::max(0.0, -2.0 * static_cast<double>(*place));
}

/// The brightness above which half of all light lies.
double typicalOf(std::vector<float> brightness) {
  std::ranges::sort(brightness);
  const auto dark = std::ranges::lower_bound(brightness, 0.0f);
  brightness.erase(brightness.begin(), dark);
  const double half = 0.5 * std::accumulate(brightness.begin(), brightness.end(), 0.0);
  double sum = 0.0;
  for (float value : brightness) {
    sum += static_cast<double>(value);
    if (sum >= half) return static_cast<double>(value);
  }
  return 0.0;
}

/// From where to where `light` lies, but for a stray share at both ends: first and end.
std::pair<int, int> extentOf(const std::vector<double>& light) {
  const double least = stray * std::accumulate(light.begin(), light.end(), 0.0);
  auto skipped = [least](const auto& values) {
    int count = 0;
    double sum = 0.0;
    for (const double value : values) {
      sum += value;
      if (sum > least) break;
      ++count;
    }
    return count;
  };
  return {skipped(light), static_cast<int>(light.size()) - skipped(light | std::views::reverse)};
}

}  // namespace

LitPart litPart(const image::Image& light) {
  require(light.channels() == 3 && light.pixels() > 0, "{}x{} pixels of {} channels", light.width(),
          light.height(), light.channels());
  const std::vector<float> brightness = brightnessOf(light);
  const double noise = noiseOf(brightness), typical = typicalOf(brightness);
  const double least = std::max(noise, scattered * typical), directly = std::max(noise, direct * typical);

  std::vector<double> columns(static_cast<std::size_t>(light.width())),
      rows(static_cast<std::size_t>(light.height()));
  for (std::size_t i = 0; i < brightness.size(); ++i) {
    if (static_cast<double>(brightness[i]) <= least) continue;
    const Pixel at = pixelAt(light.size(), i);
    columns[static_cast<std::size_t>(at.x)] += static_cast<double>(brightness[i]);
    rows[static_cast<std::size_t>(at.y)] += static_cast<double>(brightness[i]);
  }
  const auto [left, right] = extentOf(columns);
  const auto [top, bottom] = extentOf(rows);
  if (left >= right || top >= bottom) return {};

  LitPart part{{left, top}, {right - left, bottom - top}, 0};
  for (int y = top; y < bottom; ++y)
    for (int x = left; x < right; ++x)
      part.pixels += static_cast<double>(brightness[indexOf(light.size(), {x, y})]) > directly;
  return part;
}

LitPart withSurroundings(const LitPart& part, Size camera) {
  const int margin = (std::max(part.size.width, part.size.height) + surroundings - 1) / surroundings;
  auto along = [margin](int begin, int length, int all) {
    const int from = std::max(0, begin - margin), to = std::min(all, begin + length + margin);
    return std::pair(from, to - from);
  };
  LitPart result = part;
  std::tie(result.begin.x, result.size.width) = along(part.begin.x, part.size.width, camera.width);
  std::tie(result.begin.y, result.size.height) = along(part.begin.y, part.size.height, camera.height);
  return result;
}

}  // namespace relucent::reduction
