// SPDX-License-Identifier: MIT
#include "relucent/photography/bracket.h"

#include <algorithm>
#include <cmath>

namespace relucent::photography {
namespace {

constexpr double wellExposed = 0.1;  // of full scale: darker pixels add noise alone
constexpr double nearSaturation = 0.95;
constexpr double sigmas = 6.0;

double contradiction(const rig::RawFrame& longer, const rig::RawFrame& shorter,
                     const hdr::CameraModel& model) {
  double longTime = hdr::trueSeconds(model, longer.seconds),
         shortTime = hdr::trueSeconds(model, shorter.seconds);
  double expected = 0.0, found = 0.0, variance = 0.0;
  for (std::size_t at = 0; at < longer.signal.data().size(); ++at) {
    auto signal = static_cast<double>(longer.signal.data()[at]);
    if (signal >= nearSaturation * model.saturation) continue;
    const hdr::ResponseCurve& response = model.response[at % 3];
    double linear = response(signal);
    if (linear < wellExposed) continue;
    double other = response(static_cast<double>(shorter.signal.data()[at]));
    expected += linear / longTime;
    found += other / shortTime;
    variance += hdr::linearVariance(model, linear) / (longTime * longTime) +
                hdr::linearVariance(model, linear * shortTime / longTime) / (shortTime * shortTime);
  }
  double apart = std::abs(found - expected);
  return apart > sigmas * std::sqrt(variance) ? apart / expected : 0.0;
}

}  // namespace

double bracketContradiction(const rig::Shot& shot, const std::vector<hdr::CameraModel>& cameras) {
  double largest = 0.0;
  for (std::size_t camera = 0; camera < cameras.size(); ++camera) {
    for (std::size_t k = 1; k < shot.frames.size(); ++k) {
      const rig::RawFrame* longer = &shot.frames[k - 1][camera];
      const rig::RawFrame* shorter = &shot.frames[k][camera];
      if (longer->seconds < shorter->seconds) std::swap(longer, shorter);
      largest = std::max(largest, contradiction(*longer, *shorter, cameras[camera]));
    }
  }
  return largest;
}

}  // namespace relucent::photography
