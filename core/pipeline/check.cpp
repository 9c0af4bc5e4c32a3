// SPDX-License-Identifier: MIT
#include "relucent/pipeline/check.h"

#include "relucent/base/message.h"
#include "relucent/devices/check/test_exposure.h"
#include "relucent/pipeline/calibrate_settings.h"
#include "relucent/pipeline/devices.h"

namespace relucent::pipeline {

std::vector<Message> problems(const CheckSettings& settings) {
  CalibrateSettings calibrate;
  calibrate.rig = settings.rig;
  std::vector<Message> found = problems(calibrate);
  for (Message& problem : problems(settings.latency)) found.push_back(std::move(problem));
  for (Message& problem : problems(settings.proof)) found.push_back(std::move(problem));
  return found;
}

std::vector<devices::CheckVerdict> verdictsOf(const RigCheck& check) {
  std::vector<devices::CheckVerdict> all;
  for (const auto* part : {&check.proof.verdicts, &check.latency.verdicts, &check.light.verdicts})
    all.insert(all.end(), part->begin(), part->end());
  return all;
}

RigCheck checkRig(const CheckSettings& settings, const std::filesystem::path& cache, Progress& progress) {
  Progress opening = progress.part(0.2, RELUCENT_MESSAGE("stage.preparing-devices", "Preparing the devices"));
  OpenedRig devices = openRig(settings.rig, cache, opening);
  opening.report(1.0);
  rig::Projector& projector = *devices.rig.projectors.front();
  rig::Camera& camera = *devices.rig.cameras.front();

  RigCheck check;
  Progress proving = progress.part(
      0.2, RELUCENT_MESSAGE("stage.finding-projector-picture", "Looking for the projector's picture"));
  const devices::ScreenExposure exposureOf = [&](rig::Projector& screen) {
    return devices::testExposure(screen, camera, settings.latency, devices::sleepFor, proving);
  };
  std::vector<rig::Projector*> others;
  for (std::size_t i = 1; i < devices.rig.projectors.size(); ++i)
    others.push_back(devices.rig.projectors[i].get());
  check.proof = devices::proveScreen(projector, others, camera, exposureOf, settings.proof, proving);
  devices::requireSeen(check.proof, projector, camera);
  const double exposure = check.proof.exposure;

  Progress measuring =
      progress.part(0.4, RELUCENT_MESSAGE("stage.measuring-latency", "Measuring the latency"));
  check.latency =
      devices::measureLatency(projector, camera, exposure, settings.latency, devices::sleepFor, measuring);
  Progress judging = progress.part(0.2, RELUCENT_MESSAGE("stage.judging-light", "Judging the light"));
  devices::LightCheckSettings light;
  light.frame = settings.latency.frame;
  light.settle = settings.latency.mostFrames * settings.latency.frame;
  check.light = devices::checkLight(projector, camera, exposure, light, devices::sleepFor, judging);
  return check;
}

}  // namespace relucent::pipeline
