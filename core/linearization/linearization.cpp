// SPDX-License-Identifier: MIT
#include "relucent/linearization/linearization.h"

#include <algorithm>
#include <cmath>

#include "relucent/base/error.h"
#include "relucent/linearization/additivity.h"
#include "relucent/linearization/camera_noise.h"
#include "relucent/linearization/camera_response.h"
#include "relucent/linearization/exposure_choice.h"
#include "relucent/linearization/projector_ramp.h"
#include "relucent/linearization/test_light.h"

namespace relucent::linearization {
namespace {

constexpr double flickerLimit = 0.01;  // of the light between photographs, relative

std::vector<ShotPair> takePairs(rig::ShotTaker& shots, const LinearizationSettings& settings,
                                const std::vector<double>& exposures, Progress& progress) {
  // Full and half light, and what lies in the dark, so that all signals occur.
  constexpr std::array<float, 4> drives{1.0f, 0.75f, 0.5f, 0.0f};
  std::vector<ShotPair> pairs;
  for (int i = 0; i < settings.noisePairs; ++i) {
    float drive = drives[static_cast<std::size_t>(i) % drives.size()];
    std::vector<image::Image> patterns = evenPatterns(shots.rig(), {drive, drive, drive});
    rig::Shot first = shots.take(patterns, exposures, progress);
    progress.report((i + 0.5) / settings.noisePairs);
    pairs.emplace_back(std::move(first), shots.take(patterns, exposures, progress));
    progress.report((i + 1.0) / settings.noisePairs);
  }
  return pairs;
}

/// Step 2 of linearize().
void calibrateCameras(rig::ShotTaker& shots, const LinearizationSettings& settings,
                      const std::vector<double>& saturation, Linearization& result, Progress& progress) {
  const rig::Rig& rig = shots.rig();
  rig::Shot bracket =
      shots.take(evenPatterns(rig, {1, 1, 1}), responseBracket(commonRange(rig), result.exposures), progress);
  progress.report(0.3);
  Progress rest = progress.part(0.7, progress.stage());
  std::vector<ShotPair> pairs = takePairs(shots, settings, result.exposures, rest);

  for (std::size_t camera = 0; camera < rig.cameras.size(); ++camera) {
    progress.checkpoint();
    hdr::CameraModel model;
    model.saturation = saturation[camera];
    model.response = cameraResponse(bracket, camera, model.saturation).curves;
    model = withMeasuredNoise(std::move(model), pairs, camera);
    model = withMeasuredTimes(std::move(model), pairs, camera);
    double flicker = flickerOf(model, pairs, camera);
    if (flicker > flickerLimit)
      result.findings.push_back(
          RELUCENT_MESSAGE("linearization.light-flickers",
                           "{}: the light changes by {} % from one photograph to the next; switch off the "
                           "projector's dynamic lamp modes and other lamps nearby, and choose exposure times "
                           "that are multiples of the mains period")
              .with(rig.cameras[camera]->name(), as::share(flicker, as::decimals(1))));
    result.cameras.push_back(std::move(model));
  }
}

}  // namespace

std::vector<Message> problems(const LinearizationSettings& settings) {
  std::vector<Message> found;
  if (settings.levels < 5 || settings.levels > 1025)
    found.push_back(RELUCENT_ENGLISH_MESSAGE("linearization.ramp-levels-out-of-range",
                                             "a ramp has 5 to 1025 levels, not {}")
                        .with(settings.levels));
  if (!(settings.shadowPower >= 0.5 && settings.shadowPower <= 4.0))
    found.push_back(RELUCENT_ENGLISH_MESSAGE("linearization.shadow-power-out-of-range",
                                             "the shadow power is between 0.5 and 4, not {}")
                        .with(settings.shadowPower));
  if (settings.noisePairs < 1 || settings.noisePairs > 100)
    found.push_back(RELUCENT_ENGLISH_MESSAGE("linearization.noise-pairs-out-of-range",
                                             "the camera's noise takes 1 to 100 pairs of shots, not {}")
                        .with(settings.noisePairs));
  if (!(settings.additivityLimit > 0.0 && settings.additivityLimit < 1.0))
    found.push_back(RELUCENT_ENGLISH_MESSAGE("linearization.additivity-limit-out-of-range",
                                             "the additivity limit is between 0 and 1, not {}")
                        .with(settings.additivityLimit));
  return found;
}

Linearization linearize(rig::ShotTaker& shots, const LinearizationSettings& settings, Progress& progress) {
  for (const Message& problem : problems(settings)) require(false, "{}", problem);
  const rig::Rig& rig = shots.rig();
  require(!rig.projectors.empty() && !rig.cameras.empty(), "{} projectors and {} cameras make no rig",
          rig.projectors.size(), rig.cameras.size());

  Linearization result;
  Progress exposing = progress.part(0.1, RELUCENT_MESSAGE("stage.finding-exposure", "Finding the exposure"));
  ExposureChoice choice = chooseExposures(shots, exposing);
  result.exposures = choice.seconds;
  result.findings = choice.findings;

  Progress calibrating =
      progress.part(0.1, RELUCENT_MESSAGE("stage.measuring-camera", "Measuring the camera"));
  calibrateCameras(shots, settings, choice.saturation, result, calibrating);

  LightMeter meter(shots, result.cameras, result.exposures);
  double share = 0.8 / static_cast<double>(rig.projectors.size());
  for (std::size_t projector = 0; projector < rig.projectors.size(); ++projector) {
    const std::string name = rig.projectors[projector]->name();
    Progress adding = progress.part(
        0.1 * share,
        RELUCENT_MESSAGE("stage.checking-additivity", "Checking that the colours of {} add up").with(name));
    Additivity additivity = measureAdditivity(meter, projector, settings.seed, adding);
    result.additivityError.push_back(
        std::max(std::abs(additivity.white), std::abs(additivity.superposition)));
    for (Message& finding : additivityFindings(additivity, name, settings.additivityLimit))
      result.findings.push_back(std::move(finding));

    Progress ramps = progress.part(0.9 * share, RELUCENT_MESSAGE("stage.measuring-brightness-curves",
                                                                 "Measuring the brightness curves of {}")
                                                    .with(name));
    result.projectors.push_back(measureRamps(meter, projector, additivity, settings, ramps));
  }
  progress.report(1.0);
  result.times = shots.times();
  return result;
}

}  // namespace relucent::linearization
