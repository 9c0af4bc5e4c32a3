// SPDX-License-Identifier: MIT
#include "relucent/pipeline/mask_score.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace relucent::pipeline {
namespace {

/// Where every projector pixel that lights a camera pixel directly has all of its light.
CameraMask untouched(const compensation::MeasuredVenue& venue, const compensation::Target& target,
                     const compensation::DirectLightSettings& settings, Progress& progress) {
  constexpr float next = 0.999f;
  const transport::TransportMatrix direct = directPart(venue.transport, settings, progress);
  ProjectorStack left(3 * target.available.size());
  for (std::size_t i = 0; i < left.size(); ++i) left[i] = target.available[i / 3];
  const CameraStack all = direct.floodlight(), some = direct.apply(left);
  CameraMask mask(target.masked.size());
  for (std::size_t i = 0; i < mask.size(); ++i) {
    mask[i] = target.masked[i] == 0.0f && venue.usable[i] != 0;
    for (std::size_t c = 3 * i; c < 3 * i + 3; ++c) mask[i] = mask[i] && some[c] >= next * all[c];
  }
  return mask;
}

}  // namespace

MaskScore maskScore(const compensation::Compensator& compensator, const Judge& judge,
                    compensation::Method method, const image::Image& content,
                    const compensation::TargetSettings& asked, Progress& progress) {
  const compensation::MeasuredVenue& venue = compensator.venue();
  compensation::TargetSettings open = asked;
  open.masks.reset();
  struct Side {
    compensation::Target target;
    compensation::Compensation shown;
    CameraStack seen, direct;
  };
  const auto sideOf = [&](const compensation::TargetSettings& settings) {
    Side side{fitTarget(content, venue, settings), {}, {}, {}};
    side.shown = compensator.solve(method, side.target, progress);
    side.seen = judge.seen(side.shown);
    side.direct = judge.direct(side.shown, progress);
    return side;
  };
  const Side before = sideOf(open), after = sideOf(asked);

  const auto onMasks = [&](const CameraStack& light, const CameraStack& less) {
    double sum = 0.0;
    for (std::size_t i = 0; i < light.size(); ++i)
      if (after.target.masked[i / 3] >= compensation::fullyMasked && before.target.inside[i / 3] != 0)
        sum += static_cast<double>(light[i]) - static_cast<double>(less[i]);
    return sum;
  };
  const CameraStack none(before.seen.size(), 0.0f);
  const CameraMask apart = untouched(venue, after.target, compensator.settings().direct, progress);
  const auto psnr = [&](const Side& side) {
    double error = 0.0, values = 0.0;
    for (std::size_t i = 0; i < side.seen.size(); ++i) {
      if (!apart[i / 3] || !before.target.reachable[i / 3] || !after.target.reachable[i / 3]) continue;
      error += std::pow((static_cast<double>(side.seen[i]) - static_cast<double>(side.target.wanted[i])) /
                            static_cast<double>(side.target.white[0]),
                        2);
      values += 1.0;
    }
    return values > 0.0 ? -10.0 * std::log10(error / values) : std::numeric_limits<double>::quiet_NaN();
  };
  MaskScore score;
  score.method = method;
  score.light = onMasks(after.seen, judge.black()) / onMasks(before.seen, judge.black());
  score.direct = onMasks(after.direct, none) / onMasks(before.direct, none);
  score.psnrWithout = psnr(before);
  score.psnr = psnr(after);
  score.white = static_cast<double>(after.target.white[0]) / static_cast<double>(before.target.white[0]);
  return score;
}

}  // namespace relucent::pipeline
