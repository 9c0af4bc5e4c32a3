// SPDX-License-Identifier: MIT
#include "relucent/venue/sensor_model.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "relucent/base/error.h"
#include "relucent/base/fingerprint.h"
#include "relucent/base/parallel.h"
#include "relucent/base/random.h"

namespace relucent::venue {
namespace {

constexpr std::uint64_t flickerKey = 0xf11c;
constexpr std::uint64_t sensorKey = 0x5e45;

std::uint64_t stageKey(const rig::CaptureRequest& request) {
  return Fingerprint().add(request.shot.stage).low();
}

/// Standard normal values in pairs, in single precision: a photograph needs a million of them.
class FastNormal {
 public:
  explicit FastNormal(Random random) : random_(random) {}
  float operator()() {
    if (hasSpare_) {
      hasSpare_ = false;
      return spare_;
    }
    std::uint64_t bits = random_.next();
    float first = static_cast<float>((bits >> 40) + 1) * 0x1.0p-24f;
    float second = static_cast<float>(bits & 0xffffffu) * 0x1.0p-24f;
    float radius = std::sqrt(-2.0f * std::log(first));
    float angle = 2.0f * std::numbers::pi_v<float> * second;
    spare_ = radius * std::sin(angle);
    hasSpare_ = true;
    return radius * std::cos(angle);
  }

 private:
  Random random_;
  float spare_ = 0.0f;
  bool hasSpare_ = false;
};

}  // namespace

SensorModel::SensorModel(const DeviceModelSettings& settings, std::uint64_t seed, std::size_t camera)
    : settings_(settings), seed_(seed), camera_(camera) {}

double SensorModel::granted(double seconds) {
  return std::clamp(seconds, exposures().shortest, exposures().longest);
}

double SensorModel::lampPower(const rig::CaptureRequest& request) const {
  double power = 1.0 + settings_.drift * request.shot.number / 1000.0;
  if (settings_.flicker > 0.0) {
    Random random({seed_, flickerKey, stageKey(request), static_cast<std::uint64_t>(request.shot.number),
                   static_cast<std::uint64_t>(request.exposure)});
    power *= 1.0 + settings_.flicker * random.normal();
  }
  return std::max(0.0, power);
}

rig::RawFrame SensorModel::expose(const CameraStack& radiance, Size size,
                                  const rig::CaptureRequest& request) const {
  require(radiance.size() == 3 * size.count(), "{} values for {} pixels", radiance.size(), size.count());
  rig::RawFrame frame{image::Image(size, 3), settings_.cameraBits, granted(request.seconds)};
  float seconds = static_cast<float>(frame.seconds);
  float shotVariance = static_cast<float>(1.0 / settings_.fullWell);
  float readVariance = static_cast<float>(std::pow(settings_.readElectrons / settings_.fullWell, 2.0));
  float top = static_cast<float>((1 << settings_.cameraBits) - 1);
  float exponent = static_cast<float>(1.0 / settings_.cameraGamma);
  std::uint64_t stage = stageKey(request);
  std::size_t width = 3 * static_cast<std::size_t>(size.width);

  parallelFor(0, static_cast<std::size_t>(size.height), 16, [&](std::size_t y) {
    FastNormal normal(
        Random({seed_, sensorKey + (camera_ << 16), stage, static_cast<std::uint64_t>(request.shot.number),
                static_cast<std::uint64_t>(request.exposure), y}));
    for (std::size_t i = y * width; i < (y + 1) * width; ++i) {
      float light = radiance[i] * seconds;
      float signal = light + std::sqrt(std::max(0.0f, light) * shotVariance + readVariance) * normal();
      signal = std::clamp(signal, 0.0f, 1.0f);
      if (exponent != 1.0f) signal = std::pow(signal, exponent);
      frame.signal.data()[i] = std::round(signal * top) / top;
    }
  });
  return frame;
}

}  // namespace relucent::venue
