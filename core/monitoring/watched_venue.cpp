// SPDX-License-Identifier: MIT
#include "relucent/monitoring/watched_venue.h"

#include <algorithm>
#include <cmath>

#include "relucent/base/require.h"

namespace relucent::monitoring {

Observed observedOf(const rig::RawFrame& frame, const WatchedVenue& venue) {
  const Sampling& sampling = venue.sampling;
  require(frame.signal.size() == sampling.camera && frame.signal.channels() == 3,
          "a photograph of {}x{} pixels for a camera of {}x{}", frame.signal.width(), frame.signal.height(),
          sampling.camera.width, sampling.camera.height);
  const hdr::CameraModel& camera = venue.camera;
  const double seconds = hdr::trueSeconds(camera, frame.seconds);
  const double codes = frame.bits > 0 ? std::pow(2.0, frame.bits) - 1.0 : 0.0;
  const double rounding = codes > 0.0 ? 1.0 / (12.0 * codes * codes) : 0.0;
  Observed seen;
  const std::size_t values = 3 * sampling.pixels.size();
  seen.radiance.resize(values);
  seen.variance.resize(values);
  seen.valid.resize(values);
  std::size_t lost = 0;
  for (std::size_t s = 0; s < sampling.pixels.size(); ++s)
    for (std::size_t c = 0; c < 3; ++c) {
      const double signal = frame.signal.pixel(sampling.pixels[s])[c];
      const hdr::ResponseCurve& response = camera.response[c];
      const double linear = response.isIdentity() ? signal : response(signal);
      const double slope = response.isIdentity() ? 1.0 : response.slope(signal);
      const double variance = hdr::linearVariance(camera, linear) + (slope * slope - 1.0) * rounding;
      const std::size_t i = 3 * s + c;
      seen.radiance[i] = static_cast<float>(linear / seconds);
      seen.variance[i] = static_cast<float>(std::max(variance, 1e-12) / (seconds * seconds));
      seen.valid[i] = signal < camera.saturation;
      lost += seen.valid[i] == 0;
    }
  seen.saturated = static_cast<double>(lost) / static_cast<double>(std::max<std::size_t>(1, values));
  return seen;
}

double suitableExposure(const FrameMeans& frame, std::span<const double> exposures, double longest,
                        const WatchedVenue& venue) {
  require(!exposures.empty(), "no exposures");
  constexpr std::size_t mostLookedAt = 1000;
  constexpr double full = 0.8;       // of saturation
  constexpr double brighter = 0.01;  // share of values that may be
  std::vector<std::uint32_t> samples;
  const std::vector<std::uint32_t>& even = venue.sampling.even;
  const std::size_t step = std::max<std::size_t>(1, even.size() / mostLookedAt);
  for (std::size_t i = step / 2; i < even.size(); i += step) samples.push_back(even[i]);
  if (samples.empty()) return exposures.back();
  const FrameMeans* const one = &frame;
  const double all = 1.0;
  const std::vector<float> parts = venue.transport.lightOf(mixed({&one, 1}, {&all, 1}), samples);
  const std::size_t projectors = venue.transport.projectors();
  std::vector<float> radiance;
  for (std::size_t s = 0; s < samples.size(); ++s)
    for (std::size_t c = 0; c < 3; ++c) {
      float sum = venue.black[3 * samples[s] + c];
      for (std::size_t j = 0; j < projectors; ++j)
        for (std::size_t k = 0; k < 3; ++k) sum += parts[9 * (s * projectors + j) + 3 * c + k];
      radiance.push_back(sum);
    }
  const auto bright = radiance.begin() + static_cast<std::ptrdiff_t>(
                                             (1.0 - brighter) * static_cast<double>(radiance.size() - 1));
  std::nth_element(radiance.begin(), bright, radiance.end());
  for (double seconds : exposures)
    if (seconds <= longest &&
        *bright * hdr::trueSeconds(venue.camera, seconds) < full * venue.camera.saturation)
      return seconds;
  return exposures.back();
}

}  // namespace relucent::monitoring
