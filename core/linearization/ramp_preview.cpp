// SPDX-License-Identifier: MIT
#include "relucent/linearization/ramp_preview.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "relucent/linearization/mosaic.h"

namespace relucent::linearization {
namespace {

constexpr float brightest = 0.97f;
constexpr std::size_t pixels = 3000;  // of a photograph that are enough
constexpr std::size_t places = 16;    // of a light that are enough to know a pattern by

/// The only channel that a pattern shows, full wherever it is not dark.
std::optional<std::size_t> singleChannel(const image::Image& pattern) {
  std::optional<std::size_t> found;
  for (std::size_t at = 0; at < pattern.data().size(); ++at) {
    if (pattern.data()[at] == 0.0f) continue;
    if (pattern.data()[at] != 1.0f || (found && *found != at % 3)) return std::nullopt;
    found = at % 3;
  }
  return found;
}

/// Some of the pixels in which a channel is lit, evenly over all that are.
std::vector<std::size_t> litPlaces(const image::Image& pattern, std::size_t channel) {
  std::vector<std::size_t> lit, some;
  for (std::size_t i = 0; i < pattern.pixels(); ++i)
    if (pattern.pixel(i)[channel] > 0.0f) lit.push_back(i);
  for (std::size_t i = 0; i < std::min(places, lit.size()); ++i)
    some.push_back(lit[i * lit.size() / std::min(places, lit.size())]);
  return some;
}

bool isBlack(const image::Image& pattern) {
  return std::ranges::all_of(pattern.data(), [](float value) { return value == 0.0f; });
}

}  // namespace

RampPreview::Light RampPreview::lightOf(const rig::RawFrame& frame) {
  const std::size_t stride = frame.signal.pixels() / pixels + 1;
  Light light;
  for (std::size_t i = 0; i < frame.signal.pixels(); i += stride)
    for (float value : frame.signal.pixel(i))
      light.push_back(value < brightest ? static_cast<double>(value) / frame.seconds
                                        : std::numeric_limits<double>::quiet_NaN());
  return light;
}

void RampPreview::add(const image::Image& encodedPattern, const rig::RawFrame& frame) {
  if (encodedPattern.empty() || encodedPattern.channels() != 3 || frame.signal.empty() ||
      !(frame.seconds > 0.0))
    return;
  Light light = lightOf(frame);
  if (isBlack(encodedPattern)) {
    black_ = std::move(light);
  } else if (auto channel = singleChannel(encodedPattern)) {
    addKnown({*channel, litPlaces(encodedPattern, *channel), std::move(light)});
  } else {
    addMosaic(encodedPattern, light);
  }
}

void RampPreview::addKnown(Known known) {
  auto same = std::ranges::find_if(known_, [&](const Known& other) {
    return other.channel == known.channel && other.places == known.places;
  });
  if (same != known_.end()) {
    *same = std::move(known);
    return;
  }
  // Another mosaic begins.
  if (known_.size() == mosaicLights) {
    known_.clear();
    levels_ = {};
  }
  known_.push_back(std::move(known));
}

void RampPreview::addMosaic(const image::Image& pattern, const Light& light) {
  if (known_.size() < mosaicLights || black_.size() != light.size()) return;
  std::array<float, mosaicLights> drive{};
  for (std::size_t q = 0; q < mosaicLights; ++q) {
    drive[q] = pattern.pixel(known_[q].places.front())[known_[q].channel];
    for (std::size_t place : known_[q].places)
      if (pattern.pixel(place)[known_[q].channel] != drive[q]) return;
  }

  constexpr auto count = static_cast<Eigen::Index>(mosaicLights);
  Eigen::MatrixXd square = Eigen::MatrixXd::Zero(count, count);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(count), row(count);
  for (std::size_t i = 0; i < light.size(); ++i) {
    for (Eigen::Index q = 0; q < count; ++q) {
      const Light& known = known_[static_cast<std::size_t>(q)].light;
      row[q] =
          (known.size() == light.size() ? known[i] : std::numeric_limits<double>::quiet_NaN()) - black_[i];
    }
    double projected = light[i] - black_[i];
    if (!row.allFinite() || !std::isfinite(projected)) continue;
    square += row * row.transpose();
    right += projected * row;
  }
  square.diagonal().array() += 1e-9 * square.trace();
  if (!(square.trace() > 0.0)) return;
  const Eigen::VectorXd shares = square.ldlt().solve(right);
  for (std::size_t q = 0; q < mosaicLights; ++q) {
    Mean& mean = levels_[known_[q].channel][static_cast<double>(drive[q])];
    mean.sum += shares[static_cast<Eigen::Index>(q)];
    ++mean.photographs;
  }
}

std::array<std::map<double, double>, 3> RampPreview::curves() const {
  std::array<std::map<double, double>, 3> curves;
  for (std::size_t c = 0; c < 3; ++c) {
    if (levels_[c].empty()) continue;
    for (const auto& [drive, mean] : levels_[c]) curves[c][drive] = mean.sum / mean.photographs;
    curves[c][0.0] = 0.0;
    curves[c][1.0] = 1.0;
  }
  return curves;
}

}  // namespace relucent::linearization
