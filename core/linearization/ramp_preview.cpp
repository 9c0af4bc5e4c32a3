// SPDX-License-Identifier: MIT
#include "relucent/linearization/ramp_preview.h"

#include <algorithm>
#include <optional>

namespace relucent::linearization {
namespace {

// Beyond it a frame's mean is cut off by saturation in too many of its pixels.
constexpr float brightest = 0.97f;
constexpr double saturatedShare = 0.02;

/// The drive of a pattern whose pixels are all alike.
std::optional<std::array<float, 3>> evenDrive(const image::Image& pattern) {
  if (pattern.empty() || pattern.channels() != 3) return std::nullopt;
  auto first = pattern.pixel(0);
  for (std::size_t i = 1; i < pattern.pixels(); ++i)
    if (!std::equal(first.begin(), first.end(), pattern.pixel(i).begin())) return std::nullopt;
  return std::array{first[0], first[1], first[2]};
}

/// Mean light of a frame, per second; none if it is saturated.
std::optional<double> lightOf(const rig::RawFrame& frame) {
  const std::vector<float>& signal = frame.signal.data();
  if (signal.empty() || !(frame.seconds > 0.0)) return std::nullopt;
  double sum = 0.0, saturated = 0.0;
  for (float value : signal) {
    sum += static_cast<double>(value);
    if (value >= brightest) saturated += 1.0;
  }
  auto count = static_cast<double>(signal.size());
  if (saturated > saturatedShare * count) return std::nullopt;
  return sum / count / frame.seconds;
}

}  // namespace

void RampPreview::add(const image::Image& encodedPattern, const rig::RawFrame& frame) {
  auto drive = evenDrive(encodedPattern);
  auto light = lightOf(frame);
  if (!drive || !light) return;
  auto lit = std::count_if(drive->begin(), drive->end(), [](float value) { return value > 0.0f; });
  if (lit > 1) return;
  std::size_t channel = 0;
  while (channel < 2 && (*drive)[channel] <= 0.0f) ++channel;
  Mean& mean = lit == 0 ? black_ : levels_[channel][static_cast<double>((*drive)[channel])];
  mean.sum += *light;
  ++mean.frames;
}

std::array<std::map<double, double>, 3> RampPreview::curves() const {
  std::array<std::map<double, double>, 3> curves;
  if (black_.frames == 0) return curves;
  double black = black_.sum / black_.frames;
  for (std::size_t c = 0; c < 3; ++c) {
    double most = 0.0;
    for (const auto& [drive, mean] : levels_[c]) most = std::max(most, mean.sum / mean.frames - black);
    if (!(most > 0.0)) continue;
    curves[c][0.0] = 0.0;
    for (const auto& [drive, mean] : levels_[c]) curves[c][drive] = (mean.sum / mean.frames - black) / most;
  }
  return curves;
}

}  // namespace relucent::linearization
