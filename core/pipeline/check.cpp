// SPDX-License-Identifier: MIT
#include "pipeline/check.h"

#include <algorithm>

#include "pipeline/devices.h"

namespace relucent {
namespace {

/// Mean signals of white between which steps are well seen.
constexpr double dimmest = 0.15, brightest = 0.6;
constexpr int mostTrials = 16;

/// Exposure time at which white comes out between dim and bright, as far as the camera can.
double exposureFor(Projector& projector, Camera& camera, const LatencySettings& settings,
                   const Progress& progress) {
  projector.show(Image(projector.size(), 3, 1.0f));
  sleepFor(settings.mostFrames * settings.frame);
  const ExposureRange range = camera.exposures();
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

}  // namespace

std::vector<std::string> problems(const CheckSettings& settings) {
  CalibrateSettings calibrate;
  calibrate.rig = settings.rig;
  std::vector<std::string> found = problems(calibrate);
  for (std::string& problem : problems(settings.latency)) found.push_back(std::move(problem));
  return found;
}

Latency checkRig(const CheckSettings& settings, const std::filesystem::path& cache, Progress& progress) {
  Progress opening = progress.part(0.3, "Preparing the devices");
  OpenedRig devices = openRig(settings.rig, cache, opening);
  opening.report(1.0);
  Progress measuring = progress.part(0.7, "Measuring the latency");
  Projector& projector = *devices.rig.projectors.front();
  Camera& camera = *devices.rig.cameras.front();
  const double exposure = exposureFor(projector, camera, settings.latency, measuring);
  return measureLatency(projector, camera, exposure, settings.latency, sleepFor, measuring);
}

}  // namespace relucent
