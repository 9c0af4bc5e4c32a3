// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "relucent/base/error.h"
#include "relucent/base/parallel.h"
#include "relucent/hdr/hdr.h"

namespace relucent::hdr {
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
  const image::Image* signal = nullptr;
  double seconds = 0.0;
  bool linear = false;  // the sensor is: decoders change nothing
  std::array<Decoder, 3> decoders;
};

/// Exposures of one camera, shortest first.
std::vector<Exposure> exposuresOf(const rig::Shot& shot, std::size_t device, const CameraModel& camera,
                                  Size size) {
  const bool linear = std::all_of(camera.response.begin(), camera.response.end(),
                                  [](const ResponseCurve& curve) { return curve.isIdentity(); });
  std::vector<Exposure> exposures;
  for (const std::vector<rig::RawFrame>& frames : shot.frames) {
    require(device < frames.size(), "a shot of {} cameras has no camera {}", frames.size(), device);
    const rig::RawFrame& frame = frames[device];
    require(frame.signal.size() == size && frame.signal.channels() == 3, "a frame of {}x{} for {}x{} pixels",
            frame.signal.width(), frame.signal.height(), size.width, size.height);
    require(frame.seconds > 0.0, "an exposure of {} s", frame.seconds);
    exposures.push_back(
        {&frame.signal,
         trueSeconds(camera, frame.seconds),
         linear,
         {Decoder(camera, 0, frame.bits, size.count()), Decoder(camera, 1, frame.bits, size.count()),
          Decoder(camera, 2, frame.bits, size.count())}});
  }
  std::stable_sort(exposures.begin(), exposures.end(),
                   [](const Exposure& a, const Exposure& b) { return a.seconds < b.seconds; });
  return exposures;
}

/// Values that are merged together: what several exposures say about them stays in the nearest cache, and
/// loops over them become vector instructions.
constexpr std::size_t together = 192;
static_assert(together % 3 == 0, "every block begins with red");
using Values = std::array<double, together>;

/// What one exposure says about a block of values.
struct Reading {
  double seconds = 0.0;
  Values linear, extraVariance;
  Values trust;  // below 1 close to saturation, 0 beyond
};

struct Merged {
  Values radiance, variance;  // 0 where no exposure is trusted
};

/// 1 well below saturation, falling to nearly 0 there: a sharp limit would keep the darker half of a noisy
/// signal and drop the brighter one.
constexpr double fade = 0.3;
constexpr double leastTrust = 1e-3;

void read(const Exposure& exposure, std::size_t begin, std::size_t count, double saturation,
          Reading& reading) {
  reading.seconds = exposure.seconds;
  const float* signals = exposure.signal->data().data() + begin;
  const double steepness = 1.0 / (fade * saturation);
  for (std::size_t i = 0; i < count; ++i) {
    double signal = static_cast<double>(signals[i]);
    double trust = std::clamp((saturation - signal) * steepness, leastTrust, 1.0);
    reading.trust[i] = signal < saturation ? trust : 0.0;
  }
  if (exposure.linear) {
    std::copy_n(signals, count, reading.linear.begin());
    std::fill_n(reading.extraVariance.begin(), count, 0.0);
    return;
  }
  for (std::size_t i = 0; i < count; ++i)
    reading.linear[i] = exposure.decoders[i % 3](static_cast<double>(signals[i]), reading.extraVariance[i]);
}

/// The weighted means; two rounds suffice as the weights move with the square root of the noise at most.
[[gnu::always_inline]] inline void weightedMeans(std::span<const Reading> readings, std::size_t count,
                                                 const CameraModel& camera, Merged& merged) {
  const double readVariance = camera.readNoise * camera.readNoise, gain = camera.gain;
  Values weighted, weights, spread;
  auto clear = [count](Values& values) { std::fill_n(values.begin(), count, 0.0); };
  auto quotient = [](double a, double b) { return b > 0.0 ? a / b : 0.0; };

  clear(weighted), clear(weights);
  for (const Reading& reading : readings)
    for (std::size_t i = 0; i < count; ++i) {
      weighted[i] += reading.trust[i] * reading.linear[i];
      weights[i] += reading.trust[i] * reading.seconds;
    }
  for (std::size_t i = 0; i < count; ++i) merged.radiance[i] = quotient(weighted[i], weights[i]);

  for (int round = 0; round < 2; ++round) {
    clear(weighted), clear(weights), clear(spread);
    for (const Reading& reading : readings)
      for (std::size_t i = 0; i < count; ++i) {
        double plain = readVariance + gain * std::max(merged.radiance[i] * reading.seconds, 0.0);
        // Rounding is part of the read noise, so the bounds only catch a model that contradicts itself.
        double variance = std::max(std::max(plain + reading.extraVariance[i], 0.01 * plain), 1e-18);
        double weight = reading.trust[i] * (reading.seconds / variance);
        weighted[i] += weight * reading.linear[i];
        weights[i] += weight * reading.seconds;
        spread[i] += weight * reading.seconds * reading.trust[i];
      }
    for (std::size_t i = 0; i < count; ++i) {
      merged.radiance[i] = quotient(weighted[i], weights[i]);
      merged.variance[i] = quotient(spread[i], weights[i] * weights[i]);
    }
  }
}

using Means = void (*)(std::span<const Reading>, std::size_t, const CameraModel&, Merged&);

void meansBaseline(std::span<const Reading> readings, std::size_t count, const CameraModel& camera,
                   Merged& merged) {
  weightedMeans(readings, count, camera, merged);
}

#ifdef __x86_64__
// Without fused multiply-add, so that T has the same bits whatever machine it was measured with.
[[gnu::target("avx2")]] void meansAvx2(std::span<const Reading> readings, std::size_t count,
                                       const CameraModel& camera, Merged& merged) {
  weightedMeans(readings, count, camera, merged);
}
#endif

/// For the processor that runs this.
Means means() {
#ifdef __x86_64__
  static const bool newer = __builtin_cpu_supports("avx2");
  if (newer) return meansAvx2;
#endif
  return meansBaseline;
}

/// The values of one camera, from `begin` on.
struct Target {
  float* radiance;
  float* variance;
  std::uint8_t* valid;
};

void mergeBlock(const std::vector<Exposure>& exposures, const CameraModel& camera,
                const std::array<double, 3>& lowerBound, std::size_t begin, std::size_t count,
                std::vector<Reading>& readings, const Target& target) {
  for (std::size_t k = 0; k < exposures.size(); ++k)
    read(exposures[k], begin, count, camera.saturation, readings[k]);
  Merged merged;
  means()(readings, count, camera, merged);
  for (std::size_t i = 0; i < count; ++i) {
    // A trusted value's variance has a floor, so that only values without any trust have none.
    bool valid = merged.variance[i] > 0.0;
    double bound = lowerBound[i % 3];
    target.radiance[begin + i] = static_cast<float>(valid ? merged.radiance[i] : bound);
    target.variance[begin + i] = static_cast<float>(valid ? merged.variance[i] : bound * bound);
    target.valid[begin + i] = valid ? 1 : 0;
  }
}

}  // namespace

HdrFrame mergeBracket(const rig::Shot& shot, const std::vector<CameraModel>& cameras,
                      const Rasters& rasters) {
  require(!shot.frames.empty(), "shot {} {} has no exposures", shot.id.stage, shot.id.number);
  require(cameras.size() == rasters.devices(), "{} camera models for {} cameras", cameras.size(),
          rasters.devices());
  HdrFrame merged{CameraStack(3 * rasters.count()), CameraStack(3 * rasters.count()),
                  std::vector<std::uint8_t>(3 * rasters.count())};
  for (std::size_t device = 0; device < cameras.size(); ++device) {
    const CameraModel& camera = cameras[device];
    std::vector<Exposure> exposures = exposuresOf(shot, device, camera, rasters.size(device));
    std::array<double, 3> lowerBound;
    for (std::size_t c = 0; c < 3; ++c)
      lowerBound[c] = camera.response[c](camera.saturation) / exposures.front().seconds;

    std::size_t first = 3 * rasters.offset(device), values = 3 * rasters.size(device).count();
    std::size_t blocks = (values + together - 1) / together;
    Target target{merged.radiance.data() + first, merged.variance.data() + first,
                  merged.valid.data() + first};
    parallelChunks(0, blocks, blocks / 32 + 1, [&](std::size_t, std::size_t begin, std::size_t end) {
      std::vector<Reading> readings(exposures.size());
      for (std::size_t block = begin; block < end; ++block)
        mergeBlock(exposures, camera, lowerBound, block * together,
                   std::min(together, values - block * together), readings, target);
    });
  }
  return merged;
}

}  // namespace relucent::hdr
