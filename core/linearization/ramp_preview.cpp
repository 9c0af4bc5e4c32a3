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
// Of the mosaics of many projectors; no level is shown before all of them are known.
constexpr std::size_t fewestLights = 3 * mosaicGroupsOf(mosaicLights);
constexpr std::size_t places = 16;  // of a light that are enough to know a pattern by

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

void RampPreview::add(const std::vector<image::Image>& encodedPatterns, const rig::RawFrame& frame) {
  if (encodedPatterns.empty() || frame.signal.empty() || !(frame.seconds > 0.0)) return;
  std::vector<std::size_t> lit;
  for (std::size_t p = 0; p < encodedPatterns.size(); ++p) {
    if (encodedPatterns[p].empty() || encodedPatterns[p].channels() != 3) return;
    if (!isBlack(encodedPatterns[p])) lit.push_back(p);
  }
  projectors_.resize(std::max(projectors_.size(), encodedPatterns.size()));
  Light light = lightOf(frame);
  if (lit.empty()) {
    black_ = std::move(light);
    return;
  }
  const image::Image& first = encodedPatterns[lit.front()];
  if (auto channel = singleChannel(first); channel && lit.size() == 1) {
    addKnown(projectors_[lit.front()], {*channel, litPlaces(first, *channel), std::move(light)});
    return;
  }
  std::vector<Shown> shown;
  for (std::size_t p : lit) {
    const std::vector<Shown> own = shownBy(projectors_[p], encodedPatterns[p]);
    if (own.empty()) return;
    shown.insert(shown.end(), own.begin(), own.end());
  }
  if (black_.size() == light.size()) addMosaics(shown, light);
}

void RampPreview::addKnown(Measured& projector, Known known) {
  auto same = std::ranges::find_if(projector.known, [&](const Known& other) {
    return other.channel == known.channel && other.places == known.places;
  });
  if (same != projector.known.end()) {
    *same = std::move(known);
    return;
  }
  // Another mosaic begins.
  const bool hasShownLevels =
      std::ranges::any_of(projector.levels, [](const auto& own) { return !own.empty(); });
  if (projector.known.size() == mosaicLights || hasShownLevels) projector = {};
  projector.known.push_back(std::move(known));
}

std::vector<RampPreview::Shown> RampPreview::shownBy(Measured& projector, const image::Image& pattern) {
  if (projector.known.size() < fewestLights) return {};
  std::vector<double> drives;
  for (const Known& known : projector.known) {
    const float drive = pattern.pixel(known.places.front())[known.channel];
    for (std::size_t place : known.places)
      if (pattern.pixel(place)[known.channel] != drive) return {};
    drives.push_back(static_cast<double>(drive));
  }
  std::vector<Shown> shown;
  for (std::size_t q = 0; q < drives.size(); ++q) {
    const Known& known = projector.known[q];
    shown.push_back({&known, &projector.levels[known.channel][drives[q]]});
  }
  return shown;
}

void RampPreview::addMosaics(const std::vector<Shown>& shown, const Light& light) const {
  const auto count = static_cast<Eigen::Index>(shown.size());
  Eigen::MatrixXd square = Eigen::MatrixXd::Zero(count, count);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(count), row(count);
  for (std::size_t i = 0; i < light.size(); ++i) {
    for (Eigen::Index q = 0; q < count; ++q) {
      const Light& known = shown[static_cast<std::size_t>(q)].known->light;
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
  for (std::size_t q = 0; q < shown.size(); ++q) {
    shown[q].mean->sum += shares[static_cast<Eigen::Index>(q)];
    ++shown[q].mean->photographs;
  }
}

std::array<std::map<double, double>, 3> RampPreview::curves(std::size_t projector) const {
  std::array<std::map<double, double>, 3> curves;
  if (projector >= projectors_.size()) return curves;
  for (std::size_t c = 0; c < 3; ++c) {
    for (const auto& [drive, mean] : projectors_[projector].levels[c])
      if (mean.photographs > 0) curves[c][drive] = mean.sum / mean.photographs;
    if (curves[c].empty()) continue;
    curves[c][0.0] = 0.0;
    curves[c][1.0] = 1.0;
  }
  return curves;
}

}  // namespace relucent::linearization
