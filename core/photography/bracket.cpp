// SPDX-License-Identifier: MIT
#include "relucent/photography/bracket.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "relucent/base/parallel.h"

namespace relucent::photography {
namespace {

constexpr double wellExposed = 0.1;  // of full scale: darker pixels add noise alone
constexpr double nearSaturation = 0.95;
constexpr double sigmas = 6.0;

/// Where a pixel is compared must not depend on how its noise happens to make the two differ: it is chosen by
/// their mean by inverse variances, of which their difference is independent. By either alone, even light
/// near the limit would seem to change.
double contradiction(const rig::RawFrame& longer, const rig::RawFrame& shorter,
                     const hdr::CameraModel& model) {
  const double longTime = hdr::trueSeconds(model, longer.seconds),
               shortTime = hdr::trueSeconds(model, shorter.seconds);
  struct Sums {
    double expected = 0.0, found = 0.0, variance = 0.0;
  };
  std::array<Sums, fixedParts> parts{};
  const std::size_t values = longer.signal.data().size();
  parallelChunks(0, values, fixedParts, [&](std::size_t part, std::size_t begin, std::size_t end) {
    Sums sums;
    for (std::size_t at = begin; at < end; ++at) {
      auto signal = static_cast<double>(longer.signal.data()[at]);
      if (signal >= nearSaturation * model.saturation) continue;
      const hdr::ResponseCurve& response = model.response[at % 3];
      const double linear = response(signal);
      const double first = linear / longTime;
      const double second = response(static_cast<double>(shorter.signal.data()[at])) / shortTime;
      const double firstVariance = hdr::linearVariance(model, linear) / (longTime * longTime);
      const double secondVariance =
          hdr::linearVariance(model, linear * shortTime / longTime) / (shortTime * shortTime);
      const double both = firstVariance + secondVariance;
      const double mean = both > 0.0 ? (first * secondVariance + second * firstVariance) / both : first;
      if (mean * longTime < wellExposed) continue;
      sums.expected += first;
      sums.found += second;
      sums.variance += both;
    }
    parts[part] = sums;
  });
  Sums all;
  for (const Sums& sums : parts) {
    all.expected += sums.expected;
    all.found += sums.found;
    all.variance += sums.variance;
  }
  const double apart = std::abs(all.found - all.expected);
  return apart > sigmas * std::sqrt(all.variance) ? apart / all.expected : 0.0;
}

/// Two exposures, one after the other, and how much they contradict each other.
struct Neighbours {
  double apart = 0.0;
  std::size_t camera = 0;
  const rig::RawFrame *longer = nullptr, *shorter = nullptr;
  bool isLongerFirst = true;
};

/// Those that do most.
Neighbours mostApart(const rig::Shot& shot, const std::vector<hdr::CameraModel>& cameras) {
  Neighbours largest;
  for (std::size_t camera = 0; camera < cameras.size(); ++camera) {
    for (std::size_t k = 1; k < shot.frames.size(); ++k) {
      Neighbours two{0.0, camera, &shot.frames[k - 1][camera], &shot.frames[k][camera], true};
      if (two.longer->seconds < two.shorter->seconds) {
        std::swap(two.longer, two.shorter);
        two.isLongerFirst = false;
      }
      two.apart = contradiction(*two.longer, *two.shorter, cameras[camera]);
      if (two.apart > largest.apart) largest = two;
    }
  }
  return largest;
}

/// Light that falls alike on both exposures looks alike in both: none is brighter than `longest` can show.
image::Image viewOf(const rig::RawFrame& frame, double longest, const hdr::CameraModel& model) {
  const double seconds = hdr::trueSeconds(model, frame.seconds);
  image::Image view(frame.signal.size(), 1);
  std::array<double, 3> most{};
  for (std::size_t c = 0; c < 3; ++c)
    most[c] = model.response[c](nearSaturation * model.saturation) / longest;
  for (std::size_t i = 0; i < view.data().size(); ++i) {
    double light = 0.0;
    for (std::size_t c = 0; c < 3; ++c) {
      const auto signal = static_cast<double>(frame.signal.data()[3 * i + c]);
      light += std::min(most[c], model.response[c](signal) / seconds);
    }
    view.data()[i] = static_cast<float>(light);
  }
  return view;
}

std::vector<std::uint8_t> saturatedIn(const rig::RawFrame& frame, const hdr::CameraModel& model) {
  const std::vector<float>& signals = frame.signal.data();
  std::vector<std::uint8_t> saturated(signals.size() / 3, 0);
  for (std::size_t i = 0; i < signals.size(); ++i)
    if (static_cast<double>(signals[i]) >= nearSaturation * model.saturation) saturated[i / 3] = 1;
  return saturated;
}

}  // namespace

double bracketContradiction(const rig::Shot& shot, const std::vector<hdr::CameraModel>& cameras) {
  return mostApart(shot, cameras).apart;
}

std::optional<ContradictoryViews> contradictoryViews(const rig::Shot& shot,
                                                     const std::vector<hdr::CameraModel>& cameras) {
  const Neighbours two = mostApart(shot, cameras);
  if (!(two.apart > 0.0)) return std::nullopt;
  const hdr::CameraModel& model = cameras[two.camera];
  const double longest = hdr::trueSeconds(model, two.longer->seconds);
  return ContradictoryViews{two.camera, two.isLongerFirst, viewOf(*two.longer, longest, model),
                            viewOf(*two.shorter, longest, model), saturatedIn(*two.longer, model)};
}

}  // namespace relucent::photography
