// SPDX-License-Identifier: MIT
// The devices of the open calibration: opened, proved and checked.
#include <algorithm>
#include <optional>
#include <tuple>
#include <utility>

#include "relucent/base/error.h"
#include "relucent/base/message.h"
#include "relucent/devices/check/test_exposure.h"
#include "relucent/linearization/test_light.h"
#include "relucent/pipeline/screen_devices.h"
#include "relucent/rig/watched_rig.h"
#include "wizard/session/other_screens.h"
#include "wizard/session/session.h"

namespace relucent::gui {
namespace {

/// Holds other screens up as the rig's own projectors, which their pictures are not to be taken for.
class OtherScreensWatcher : public rig::RigWatcher {
 public:
  explicit OtherScreensWatcher(std::shared_ptr<LiveRig> live) : live_(std::move(live)) {}
  void beforeShowing(std::size_t index, rig::RigLight& light) override { live_->beforeShowing(index, light); }

 private:
  std::shared_ptr<LiveRig> live_;
};

}  // namespace

/// Contract: guard_ is held.
rig::Rig& SessionDevices::opened(Progress& progress) {
  if (!opened_) {
    Progress opening = progress.part(hasScreen() ? 0.3 : 1.0,
                                     RELUCENT_MESSAGE("stage.preparing-devices", "Preparing the devices"));
    warmUp_.switchOn(opening);
    pipeline::OpenedRig opened = pipeline::openRig(settings_, cache_, screens_, opening);
    if (opened.venue && surprises_)
      opened.rig = opened.venue->rig(
          [surprises = surprises_](const rig::ShotId& shot) { return surprises->during(shot); });
    // What is simulated answers at once, but for a surprise.
    if (!opened.venue || surprises_)
      for (std::unique_ptr<rig::Camera>& camera : opened.rig.cameras)
        camera = std::make_unique<PatientCamera>(std::move(camera), waiting_);
    opened.rig = rig::watched(std::move(opened.rig), live_);
    {
      std::scoped_lock instant(screenGuard_);
      screen_ = opened.screen;
      if (screen_) screen_->setLatency(latency_.value_or(unmeasuredLatency()));
    }
    opened_ = std::move(opened);
  }
  return opened_->rig;
}

rig::Rig& SessionDevices::open(Progress& progress) {
  std::scoped_lock lock(guard_);
  rig::Rig& rig = opened(progress);
  // A camera that was turned away is looked through again.
  if (hasScreen() && !proof_.isSeen) prove(progress);
  if (!isWarm_) warmUp_.awaitSteadyLight(rig, progress);
  isWarm_ = true;
  return rig;
}

rig::Rig& SessionDevices::openUnproved(Progress& progress) {
  std::scoped_lock lock(guard_);
  return opened(progress);
}

void SessionDevices::lookFirst(const Progress& progress) {
  std::scoped_lock lock(guard_);
  require(opened_ && hasScreen(), "only an open screen is looked at first");
  devices::LatencySettings settling;
  settling.mostFrames = 1;  // show() waits long enough
  rig::Rig& rig = opened_->rig;
  for (std::size_t camera = 0; camera < rig.cameras.size(); ++camera)
    std::ignore = devices::testExposure(*rig.projectors[std::min(camera, rig.projectors.size() - 1)],
                                        *rig.cameras[camera], settling, devices::sleepFor, progress);
}

/// Of several projectors and cameras: which camera sees which projector is nobody's to say before, but each
/// camera sees one of them, and each of them is seen.
void SessionDevices::proveEach(const std::vector<rig::Projector*>& others, Progress& progress) {
  rig::Rig& rig = opened_->rig;
  devices::LatencySettings settling;
  settling.mostFrames = 1;  // show() waits long enough
  std::vector<std::optional<std::size_t>> watching(rig.projectors.size());
  std::optional<devices::ScreenProof> first;
  const auto proved = [&](std::size_t projector, std::size_t camera,
                          const std::vector<rig::Projector*>& beside) {
    const devices::ScreenExposure exposureOf = [&](rig::Projector& screen) {
      return devices::testExposure(screen, *rig.cameras[camera], settling, devices::sleepFor, progress);
    };
    devices::ScreenProof proof = devices::proveScreen(*rig.projectors[projector], beside,
                                                      *rig.cameras[camera], exposureOf, {}, progress);
    linearization::showEven(rig, {0, 0, 0});
    if (proof.isSeen && !watching[projector]) {
      watching[projector] = camera;
      if (projector == 0) first = proof;
    }
    return proof;
  };
  for (std::size_t camera = 0; camera < rig.cameras.size(); ++camera) {
    bool sees = false;
    // Those that nobody was seen to see come first.
    for (bool isWatched : {false, true})
      for (std::size_t projector = 0; projector < rig.projectors.size() && !sees; ++projector)
        if (watching[projector].has_value() == isWatched) sees = proved(projector, camera, {}).isSeen;
    if (!sees) devices::requireSeen(proved(0, camera, others), *rig.projectors.front(), *rig.cameras[camera]);
  }
  for (std::size_t projector = 0; projector < rig.projectors.size(); ++projector) {
    for (std::size_t camera = 0; camera < rig.cameras.size() && !watching[projector]; ++camera)
      proved(projector, camera, {});
    if (watching[projector]) continue;
    throw devices::ScreenNotSeen(
        ErrorKind::device,
        RELUCENT_MESSAGE("device.projector-unseen", "no camera sees what is shown on {}")
            .with(rig.projectors[projector]->name()),
        RELUCENT_MESSAGE("device.check-projector-or-aim-another",
                         "check that this projector is on and shows that output, and aim a camera at it; or "
                         "remove it from the venue"),
        rig.projectors[projector]->name());
  }
  proof_ = *first;
  watching_.clear();
  for (const std::optional<std::size_t>& camera : watching) watching_.push_back(*camera);
}

void SessionDevices::prove(Progress& progress) {
  Progress proving = progress.part(
      0.7, RELUCENT_MESSAGE("stage.finding-projector-picture", "Looking for the projector's picture"));
  rig::Projector& projector = *opened_->rig.projectors.front();
  rig::Camera& camera = *opened_->rig.cameras.front();
  devices::LatencySettings settling;
  settling.mostFrames = 1;  // show() waits long enough
  rig::Rig beside;  // watched as well: they flash no quicker, and pause as the projector's own screen does
  for (const pipeline::ScreenRigSettings& other :
       askForOtherScreens(std::get<pipeline::ScreenRigSettings>(settings_)))
    beside.projectors.push_back(devices::delayed(screens_(other), unmeasuredLatency(), devices::sleepFor));
  beside = rig::watched(std::move(beside), std::make_shared<OtherScreensWatcher>(live_));
  std::vector<rig::Projector*> others;
  for (const std::unique_ptr<rig::Projector>& other : beside.projectors) others.push_back(other.get());
  if (opened_->rig.projectors.size() > 1 || opened_->rig.cameras.size() > 1)
    return proveEach(others, proving);
  const devices::ScreenExposure exposureOf = [&](rig::Projector& screen) {
    return devices::testExposure(screen, camera, settling, devices::sleepFor, proving);
  };
  proof_ = devices::proveScreen(projector, others, camera, exposureOf, {}, proving);
  // Photographs that are kept may be read for a while before anything else is shown.
  linearization::showEven(opened_->rig, {0, 0, 0});
  devices::requireSeen(proof_, projector, camera);
  watching_ = {0};
}

pipeline::RigCheck SessionDevices::check(Progress& progress) {
  std::scoped_lock lock(guard_);
  require(opened_ && hasScreen(), "only an open screen is checked");
  const auto share = 1.0 / static_cast<double>(watching_.size());
  pipeline::RigCheck check;
  for (std::size_t projector = 0; projector < watching_.size(); ++projector) {
    Progress checking = progress.part(
        share, RELUCENT_MESSAGE("stage.checking-projector-and-camera", "Checking projector and camera"));
    pipeline::RigCheck of = checkOne(projector, checking);
    if (projector == 0) {
      check = std::move(of);
      continue;
    }
    // All are waited for as long as the slowest needs; what the others do besides is said.
    auto add = [](std::vector<devices::CheckVerdict>& to, const std::vector<devices::CheckVerdict>& more) {
      to.insert(to.end(), more.begin(), more.end());
    };
    std::vector<devices::CheckVerdict> latency = check.latency.verdicts, light = check.light.verdicts;
    add(latency, of.latency.verdicts);
    add(light, of.light.verdicts);
    if (of.latency.seconds > check.latency.seconds) check.latency = of.latency;
    check.latency.verdicts = std::move(latency);
    check.light.verdicts = std::move(light);
  }
  setLatency(check.latency.seconds);
  return check;
}

/// Of one projector, by the camera that sees it.
pipeline::RigCheck SessionDevices::checkOne(std::size_t index, Progress& progress) {
  rig::Projector& projector = *opened_->rig.projectors[index];
  rig::Camera& camera = *opened_->rig.cameras[watching_[index]];
  const double frame =
      1.0 / pipeline::screensOf(std::get<pipeline::ScreenRigSettings>(settings_))[index].frameRate;
  if (watching_.size() > 1) linearization::showEven(opened_->rig, {0, 0, 0});
  pipeline::RigCheck check;
  check.proof = proof_;
  double exposure = proof_.exposure;
  if (index > 0) {
    devices::LatencySettings settling;
    settling.mostFrames = 1;
    exposure = devices::testExposure(projector, camera, settling, devices::sleepFor, progress);
  }

  Progress measuring =
      progress.part(0.6, RELUCENT_MESSAGE("stage.measuring-latency", "Measuring the latency"));
  devices::LatencySettings latency;
  latency.frame = frame;
  latency.mostFrames = patience_.mostFrames;
  screen()->setLatency(0.0);
  try {
    check.latency =
        devices::measureLatency(projector, camera, exposure, latency, devices::sleepFor, measuring);
  } catch (...) {
    screen()->setLatency(unmeasuredLatency());
    throw;
  }
  setLatency(check.latency.seconds);

  Progress judging = progress.part(0.4, RELUCENT_MESSAGE("stage.judging-light", "Judging the light"));
  devices::LightCheckSettings light;
  light.frame = frame;
  light.photographs = patience_.photographs;
  light.settle = patience_.mostFrames * frame;
  // Within a frame: that is what is judged.
  screen()->setWholeFrames(false);
  try {
    check.light = devices::checkLight(projector, camera, exposure, light, devices::sleepFor, judging);
  } catch (...) {
    screen()->setWholeFrames(true);
    throw;
  }
  screen()->setWholeFrames(true);
  return check;
}

std::shared_ptr<devices::ScreenControl> SessionDevices::screen() const {
  std::scoped_lock instant(screenGuard_);
  return screen_;
}

/// Long enough for most projectors: what proves the screen comes before what measures.
double SessionDevices::unmeasuredLatency() const {
  return patience_.mostFrames / std::get<pipeline::ScreenRigSettings>(settings_).frameRate / 3.0;
}

void SessionDevices::setLatency(double seconds) {
  std::scoped_lock instant(screenGuard_);
  latency_ = seconds;
  if (screen_) screen_->setLatency(seconds);
}

void SessionDevices::rest() {
  if (std::shared_ptr<devices::ScreenControl> used = screen()) used->rest();
}

}  // namespace relucent::gui
