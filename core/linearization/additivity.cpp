// SPDX-License-Identifier: MIT
#include "relucent/linearization/additivity.h"

#include <algorithm>
#include <cmath>

#include "relucent/base/error.h"
#include "relucent/base/random.h"

namespace relucent::linearization {
namespace {

constexpr int halves = 2;
constexpr int shotCount = 7 + 2 * halves;

/// A random half of the projector's blocks lit, and the other half.
std::pair<std::vector<image::Image>, std::vector<image::Image>> randomHalves(const rig::Rig& rig,
                                                                             std::size_t projector,
                                                                             Random random) {
  std::vector<image::Image> half = evenPatterns(rig, {0, 0, 0}), rest = half;
  Size size = half[projector].size();
  int side = std::max(1, std::min(size.width, size.height) / 8);
  int across = (size.width + side - 1) / side;
  std::vector<std::uint64_t> lit(static_cast<std::size_t>(across * ((size.height + side - 1) / side)));
  for (std::size_t block = 0; block < lit.size(); ++block) lit[block] = random.below(2);
  for (std::size_t i = 0; i < size.count(); ++i) {
    Pixel pixel = pixelAt(size, i);
    bool first = lit[static_cast<std::size_t>(pixel.y / side * across + pixel.x / side)] != 0;
    std::ranges::fill((first ? half : rest)[projector].pixel(i), 1.0f);
  }
  return {half, rest};
}

/// Sums over each camera channel of white's well-lit values, so that their noise does not matter.
class ChannelSums {
 public:
  ChannelSums(const hdr::HdrFrame& white, const hdr::HdrFrame& black) : black_(black) {
    double brightest = 0.0;
    for (std::size_t at = 0; at < white.radiance.size(); ++at)
      brightest = std::max(brightest, static_cast<double>(white.radiance[at] - black.radiance[at]));
    for (std::size_t at = 0; at < white.radiance.size(); ++at) {
      bool usable = white.valid[at] != 0 && black.valid[at] != 0;
      if (usable && static_cast<double>(white.radiance[at] - black.radiance[at]) > 0.05 * brightest)
        used_[at % 3].push_back(at);
    }
  }

  std::array<double, 3> of(const hdr::HdrFrame& frame) const {
    std::array<double, 3> sums{};
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t at : used_[c])
        sums[c] += static_cast<double>(frame.radiance[at]) - static_cast<double>(black_.radiance[at]);
    return sums;
  }

 private:
  const hdr::HdrFrame& black_;
  std::array<std::vector<std::size_t>, 3> used_;
};

/// The largest relative deviation by magnitude, with its sign.
double worst(const std::array<double, 3>& sum, const std::array<double, 3>& reference) {
  double found = 0.0;
  for (std::size_t c = 0; c < 3; ++c) {
    double deviation = reference[c] > 0.0 ? sum[c] / reference[c] - 1.0 : 0.0;
    if (std::abs(deviation) > std::abs(found)) found = deviation;
  }
  return found;
}

std::array<double, 3> operator+(std::array<double, 3> a, const std::array<double, 3>& b) {
  for (std::size_t c = 0; c < 3; ++c) a[c] += b[c];
  return a;
}

}  // namespace

Additivity measureAdditivity(const LightMeter& meter, std::size_t projector, std::uint64_t seed,
                             Progress& progress) {
  const rig::Rig& rig = meter.rig();
  int taken = 0;
  auto shoot = [&](const std::vector<image::Image>& patterns) {
    hdr::HdrFrame frame = meter.measure(patterns, progress);
    progress.report(static_cast<double>(++taken) / shotCount);
    return frame;
  };
  auto even = [&](Drive drive) { return shoot(evenPatterns(rig, projector, drive)); };

  // White and black stand at both ends: what changes evenly meanwhile falls out of their means.
  hdr::HdrFrame blackBefore = even({0, 0, 0}), whiteBefore = even({1, 1, 1});
  std::array<hdr::HdrFrame, 3> primary{even({1, 0, 0}), even({0, 1, 0}), even({0, 0, 1})};
  hdr::HdrFrame whiteAfter = even({1, 1, 1}), blackAfter = even({0, 0, 0});
  hdr::HdrFrame white = hdr::meanOf({whiteBefore, whiteAfter}),
                black = hdr::meanOf({blackBefore, blackAfter});

  Additivity result;
  result.whiteWeights = LightWeights(white, black);
  if (result.whiteWeights.empty())
    throw Error(
        ErrorKind::input,
        RELUCENT_ENGLISH_MESSAGE("linearization.white-not-measurable",
                                 "no camera can measure the white of this projector"),
        RELUCENT_ENGLISH_MESSAGE(
            "linearization.check-view-and-exposure",
            "check that its picture is in view and not overexposed: close the aperture or lower the gain"),
        rig.projectors[projector]->name());
  for (std::size_t c = 0; c < 3; ++c) {
    result.channelWeights[c] = LightWeights(primary[c], black);
    if (!result.channelWeights[c].empty()) continue;
    static constexpr std::array<const char*, 3> names{"red", "green", "blue"};
    throw Error(ErrorKind::input,
                RELUCENT_ENGLISH_MESSAGE("linearization.colour-not-seen",
                                         "no camera sees the {} light of this projector")
                    .with(names[c]),
                RELUCENT_ENGLISH_MESSAGE(
                    "linearization.check-cable-and-colours",
                    "check its cable and colour settings, and that a camera looks at its picture"),
                rig.projectors[projector]->name());
  }

  ChannelSums sums(white, black);
  result.white = worst(sums.of(white), sums.of(primary[0]) + sums.of(primary[1]) + sums.of(primary[2]));
  for (int i = 0; i < halves; ++i) {
    auto [half, rest] = randomHalves(rig, projector, Random{seed, projector, static_cast<std::uint64_t>(i)});
    std::array<double, 3> first = sums.of(shoot(half));
    double deviation = worst(first + sums.of(shoot(rest)), sums.of(white));
    if (std::abs(deviation) > std::abs(result.superposition)) result.superposition = deviation;
  }
  return result;
}

namespace {

Message superpositionFinding(double excess, const std::string& projector) {
  const Argument share = as::share(std::abs(excess), as::decimals(0));
  return excess > 0.0 ? RELUCENT_MESSAGE(
                            "linearization.halves-brighter-than-whole",
                            "{}: two halves of a picture are {} % brighter than the whole; switch off the "
                            "dynamic iris, dynamic contrast and any picture mode that adapts to the content")
                            .with(projector, share)
                      : RELUCENT_MESSAGE(
                            "linearization.halves-darker-than-whole",
                            "{}: two halves of a picture are {} % darker than the whole; switch off the "
                            "dynamic iris, dynamic contrast and any picture mode that adapts to the content")
                            .with(projector, share);
}

}  // namespace

std::vector<Message> additivityFindings(const Additivity& additivity, const std::string& projector,
                                        double limit) {
  std::vector<Message> findings;
  const Argument share = as::share(std::abs(additivity.white), as::decimals(0));
  if (additivity.white > limit)
    findings.push_back(
        RELUCENT_MESSAGE(
            "linearization.white-brighter-than-colours",
            "{}: white is {} % brighter than red, green and blue together; switch off the white segment "
            "(often called brilliant colour or bright mode) and choose a picture mode for video or sRGB")
            .with(projector, share));
  if (additivity.white < -limit)
    findings.push_back(RELUCENT_MESSAGE("linearization.white-darker-than-colours",
                                        "{}: white is {} % darker than red, green and blue together; switch "
                                        "off power saving, colour management and dynamic picture modes")
                           .with(projector, share));
  if (std::abs(additivity.superposition) > limit)
    findings.push_back(superpositionFinding(additivity.superposition, projector));
  return findings;
}

}  // namespace relucent::linearization
