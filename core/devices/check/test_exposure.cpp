// SPDX-License-Identifier: MIT
#include "relucent/devices/check/test_exposure.h"

#include <algorithm>

namespace relucent::devices {
namespace {

constexpr double dimmest = 0.15, brightest = 0.6;
constexpr int mostTrials = 16;

}  // namespace

double testExposure(rig::Projector& projector, rig::Camera& camera, const LatencySettings& settings,
                    const Wait& wait, const Progress& progress) {
  projector.show(image::Image(projector.size(), 3, 1.0f));
  wait(settings.mostFrames * settings.frame);
  const rig::ExposureRange range = camera.exposures();
  double exposure = std::clamp(settings.frame, range.shortest, range.longest);
  for (int trial = 0; trial < mostTrials; ++trial) {
    progress.checkpoint();
    const double mean = meanSignal(camera.capture({{"check", trial}, 0, exposure}));
    if (mean >= dimmest && mean <= brightest) break;
    const double next =
        std::clamp(mean < dimmest ? 2.0 * exposure : 0.5 * exposure, range.shortest, range.longest);
    if (next == exposure) break;
    exposure = next;
  }
  return exposure;
}

}  // namespace relucent::devices
