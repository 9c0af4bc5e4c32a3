// SPDX-License-Identifier: MIT
#include "pipeline/check.h"

#include "base/message.h"
#include "devices/test_exposure.h"
#include "pipeline/calibrate_settings.h"
#include "pipeline/devices.h"

namespace relucent {

std::vector<Message> problems(const CheckSettings& settings) {
  CalibrateSettings calibrate;
  calibrate.rig = settings.rig;
  std::vector<Message> found = problems(calibrate);
  for (Message& problem : problems(settings.latency)) found.push_back(std::move(problem));
  for (Message& problem : problems(settings.proof)) found.push_back(std::move(problem));
  return found;
}

std::vector<CheckVerdict> verdictsOf(const RigCheck& check) {
  std::vector<CheckVerdict> all;
  for (const auto* part : {&check.proof.verdicts, &check.latency.verdicts, &check.light.verdicts})
    all.insert(all.end(), part->begin(), part->end());
  return all;
}

RigCheck checkRig(const CheckSettings& settings, const std::filesystem::path& cache, Progress& progress) {
  Progress opening = progress.part(0.2, RELUCENT_MESSAGE("stage.preparing-devices", "Preparing the devices"));
  OpenedRig devices = openRig(settings.rig, cache, opening);
  opening.report(1.0);
  Projector& projector = *devices.rig.projectors.front();
  Camera& camera = *devices.rig.cameras.front();

  RigCheck check;
  Progress proving = progress.part(
      0.2, RELUCENT_MESSAGE("stage.looking-projector-picture", "Looking for the projector's picture"));
  const ScreenExposure exposureOf = [&](Projector& screen) {
    return testExposure(screen, camera, settings.latency, sleepFor, proving);
  };
  std::vector<Projector*> others;
  for (std::size_t i = 1; i < devices.rig.projectors.size(); ++i)
    others.push_back(devices.rig.projectors[i].get());
  check.proof = proveScreen(projector, others, camera, exposureOf, settings.proof, proving);
  requireSeen(check.proof, projector, camera);
  const double exposure = check.proof.exposure;

  Progress measuring =
      progress.part(0.4, RELUCENT_MESSAGE("stage.measuring-latency", "Measuring the latency"));
  check.latency = measureLatency(projector, camera, exposure, settings.latency, sleepFor, measuring);
  Progress judging = progress.part(0.2, RELUCENT_MESSAGE("stage.judging-light", "Judging the light"));
  LightCheckSettings light;
  light.frame = settings.latency.frame;
  light.settle = settings.latency.mostFrames * settings.latency.frame;
  check.light = checkLight(projector, camera, exposure, light, sleepFor, judging);
  return check;
}

}  // namespace relucent
