// SPDX-License-Identifier: MIT
#include "hdr/hdr.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/error.h"
#include "base/parallel.h"

namespace relucent {
namespace {

/// One channel of one frame, ready to be read: signal -> linear signal and the variance of rounding.
/// Whole codes go through tables where those are the smaller work; the rest through the curve.
class Decoder {
 public:
  Decoder(const CameraModel& camera, std::size_t channel, int bits, std::size_t pixels)
      : curve_(&camera.response[channel]), identity_(curve_->isIdentity()) {
    if (bits > 0) {
      codes_ = std::ldexp(1.0, bits) - 1.0;
      rounding_ = 1.0 / (12.0 * codes_ * codes_);
    }
    bool worthATable = bits > 0 && codes_ < static_cast<double>(pixels);
    if (identity_ || !worthATable) return;
    for (double code = 0.0; code <= codes_; ++code) {
      linear_.push_back((*curve_)(code / codes_));
      extra_.push_back(extraAt(code / codes_));
    }
  }

  /// The linear signal; `extraVariance` becomes (slope^2 - 1) q^2.
  double operator()(double signal, double& extraVariance) const {
    extraVariance = 0.0;
    if (identity_) return signal;
    if (!linear_.empty() && signal >= 0.0 && signal <= 1.0) {
      auto code = static_cast<std::size_t>(std::lround(signal * codes_));
      extraVariance = extra_[code];
      return linear_[code];
    }
    extraVariance = extraAt(signal);
    return (*curve_)(signal);
  }

 private:
  double extraAt(double signal) const {
    double slope = curve_->slope(signal);
    return (slope * slope - 1.0) * rounding_;
  }

  const ResponseCurve* curve_;
  bool identity_;
  double codes_ = 0.0;
  double rounding_ = 0.0;
  std::vector<double> linear_, extra_;
};

/// One exposure of a bracket as one camera took it.
struct Exposure {
  const Image* signal = nullptr;
  double seconds = 0.0;
  std::array<Decoder, 3> decoders;
};

/// What one exposure says about one value.
struct Sample {
  double linear = 0.0;
  double seconds = 0.0;
  double trust = 1.0;  // below 1 close to saturation
  double extraVariance = 0.0;
};

struct Merged {
  double radiance = 0.0;
  double variance = 0.0;
  bool valid = false;
};

/// Exposures of one camera, shortest first.
std::vector<Exposure> exposuresOf(const Shot& shot, std::size_t device, const CameraModel& camera,
                                  Size size) {
  std::vector<Exposure> exposures;
  for (const std::vector<RawFrame>& frames : shot.frames) {
    require(device < frames.size(), "a shot of {} cameras has no camera {}", frames.size(), device);
    const RawFrame& frame = frames[device];
    require(frame.signal.size() == size && frame.signal.channels() == 3, "a frame of {}x{} for {}x{} pixels",
            frame.signal.width(), frame.signal.height(), size.width, size.height);
    require(frame.seconds > 0.0, "an exposure of {} s", frame.seconds);
    exposures.push_back(
        {&frame.signal,
         trueSeconds(camera, frame.seconds),
         {Decoder(camera, 0, frame.bits, size.count()), Decoder(camera, 1, frame.bits, size.count()),
          Decoder(camera, 2, frame.bits, size.count())}});
  }
  std::stable_sort(exposures.begin(), exposures.end(),
                   [](const Exposure& a, const Exposure& b) { return a.seconds < b.seconds; });
  return exposures;
}

double varianceOf(const CameraModel& camera, double linear, double extra) {
  double variance = linearVariance(camera, linear);
  // Rounding is part of the read noise, so this bound only catches a model that contradicts itself.
  return std::max({variance + extra, 0.01 * variance, 1e-18});
}

/// 1 well below saturation, falling to nearly 0 there: a sharp limit would keep the darker half of a noisy
/// signal and drop the brighter one.
double trustIn(double signal, double saturation) {
  constexpr double fade = 0.3;
  return std::clamp((saturation - signal) / (fade * saturation), 1e-3, 1.0);
}

/// The weighted mean; two rounds suffice as the weights move with the square root of the noise at most.
Merged weightedMean(const std::vector<Sample>& samples, const CameraModel& camera) {
  double signals = 0.0, seconds = 0.0;
  for (const Sample& sample : samples) {
    signals += sample.trust * sample.linear;
    seconds += sample.trust * sample.seconds;
  }
  Merged merged{signals / seconds, 0.0, true};
  for (int round = 0; round < 2; ++round) {
    double weighted = 0.0, weights = 0.0, spread = 0.0;
    for (const Sample& sample : samples) {
      double variance = varianceOf(camera, merged.radiance * sample.seconds, sample.extraVariance);
      double precision = sample.seconds * sample.seconds / variance;
      weighted += sample.trust * precision * sample.linear / sample.seconds;
      weights += sample.trust * precision;
      spread += sample.trust * sample.trust * precision;
    }
    merged.radiance = weighted / weights;
    merged.variance = spread / (weights * weights);
  }
  return merged;
}

Merged mergeValue(const std::vector<Exposure>& exposures, std::size_t at, const CameraModel& camera,
                  double linearSaturation, std::vector<Sample>& samples) {
  samples.clear();
  for (const Exposure& exposure : exposures) {
    double signal = static_cast<double>(exposure.signal->data()[at]);
    if (signal >= camera.saturation) continue;
    Sample sample;
    sample.linear = exposure.decoders[at % 3](signal, sample.extraVariance);
    sample.seconds = exposure.seconds;
    sample.trust = trustIn(signal, camera.saturation);
    samples.push_back(sample);
  }
  if (!samples.empty()) return weightedMean(samples, camera);
  double bound = linearSaturation / exposures.front().seconds;
  return {bound, bound * bound, false};
}

}  // namespace

double trueSeconds(const CameraModel& camera, double reported) {
  const std::vector<ExposureTime>& times = camera.times;
  if (times.empty()) return reported;
  auto after = std::lower_bound(times.begin(), times.end(), reported,
                                [](const ExposureTime& time, double value) { return time.reported < value; });
  if (after == times.begin()) return reported * after->scale;
  auto before = after - 1;
  if (after == times.end()) return reported * before->scale;
  double share = std::log(reported / before->reported) / std::log(after->reported / before->reported);
  return reported * (before->scale + share * (after->scale - before->scale));
}

HdrFrame mergeBracket(const Shot& shot, const std::vector<CameraModel>& cameras, const Rasters& rasters) {
  require(!shot.frames.empty(), "shot {} {} has no exposures", shot.id.stage, shot.id.number);
  require(cameras.size() == rasters.devices(), "{} camera models for {} cameras", cameras.size(),
          rasters.devices());
  HdrFrame merged{Stack(3 * rasters.count()), Stack(3 * rasters.count()),
                  std::vector<std::uint8_t>(3 * rasters.count())};
  for (std::size_t device = 0; device < cameras.size(); ++device) {
    const CameraModel& camera = cameras[device];
    std::vector<Exposure> exposures = exposuresOf(shot, device, camera, rasters.size(device));
    std::array<double, 3> linearSaturation;
    for (std::size_t c = 0; c < 3; ++c) linearSaturation[c] = camera.response[c](camera.saturation);

    std::size_t first = 3 * rasters.offset(device), values = 3 * rasters.size(device).count();
    parallelChunks(0, values, values / 4096 + 1, [&](std::size_t, std::size_t begin, std::size_t end) {
      std::vector<Sample> samples;
      for (std::size_t at = begin; at < end; ++at) {
        Merged value = mergeValue(exposures, at, camera, linearSaturation[at % 3], samples);
        merged.radiance[first + at] = static_cast<float>(value.radiance);
        merged.variance[first + at] = static_cast<float>(value.variance);
        merged.valid[first + at] = value.valid ? 1 : 0;
      }
    });
  }
  return merged;
}

HdrFrame meanOf(const std::vector<HdrFrame>& frames) {
  require(!frames.empty(), "no frames to take the mean of");
  std::size_t values = frames.front().radiance.size();
  for (const HdrFrame& frame : frames)
    require(
        frame.radiance.size() == values && frame.variance.size() == values && frame.valid.size() == values,
        "frames of {} and {} values", values, frame.radiance.size());
  HdrFrame mean = frames.front();
  parallelFor(0, values, 4096, [&](std::size_t at) {
    double radiance = 0.0, variance = 0.0;
    int count = 0;
    for (const HdrFrame& frame : frames) {
      if (frame.valid[at] == 0) {
        if (mean.valid[at] == 0 && frame.radiance[at] > mean.radiance[at]) {
          mean.radiance[at] = frame.radiance[at];
          mean.variance[at] = frame.variance[at];
        }
        continue;
      }
      radiance += frame.radiance[at];
      variance += frame.variance[at];
      ++count;
    }
    if (count == 0) return;
    mean.radiance[at] = static_cast<float>(radiance / count);
    mean.variance[at] = static_cast<float>(variance / count / count);
    mean.valid[at] = 1;
  });
  return mean;
}

}  // namespace relucent
