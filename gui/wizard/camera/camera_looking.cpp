// SPDX-License-Identifier: MIT
// How the page of the camera looks: checks of the devices, then one photograph after the other, on a thread
// of its own.
#include <QElapsedTimer>
#include <QThread>
#include <algorithm>
#include <utility>

#include "relucent/base/message.h"
#include "relucent/linearization/test_light.h"
#include "relucent/platform/memory_limits.h"
#include "wizard/camera/camera_page.h"

namespace relucent::gui {
namespace {

constexpr double saturation = 0.97, dark = 0.01;
constexpr unsigned long restMilliseconds = 20;  // between two checks of an answer that is waited for

image::Region centre(Size camera) {
  return {camera.width * 3 / 8, camera.height * 3 / 8, std::max(2, camera.width / 4),
          std::max(2, camera.height / 4)};
}

}  // namespace

/// What the looking thread and the interface tell each other.
struct CameraPage::Shared {
  QMutex guard;
  std::optional<pipeline::RigCheck> check;
  std::optional<linearization::ExposureChoice> choice;
  std::vector<pipeline::PixelForecast> pixels;
  std::optional<linearization::RigCoverage> coverage;
  std::vector<Watched> cameras;  // all but what is best
  std::size_t exposure = 0;
  bool posted = false;
};

/// A photograph that the checks took with all projectors white.
void CameraPage::lookAtCheck() {
  if (!isChecking()) return;
  bool isWhite = false;
  for (std::size_t projector = 0; projector < projectors(); ++projector) {
    const LivePictures live = session_.live().pictures(projector);
    const std::vector<float>& drive = live.pattern.data();
    isWhite =
        isWhite || (!drive.empty() && std::ranges::all_of(drive, [](float value) { return value >= 1.0f; }));
  }
  if (!isWhite) return;
  cameras_.resize(std::max(cameras_.size(), cameras()));
  std::vector<std::pair<rig::RawFrame, image::Region>> seen;
  for (std::size_t camera = 0; camera < cameras_.size(); ++camera) {
    rig::RawFrame frame = session_.live().pictures(0, camera).frame;
    if (!frame.signal.empty() && cameras_[camera].area == image::Region{})
      cameras_[camera].area = centre(frame.signal.size());
    seen.emplace_back(std::move(frame), cameras_[camera].area);
  }
  firstLooks_.ask([of = shared_, seen = std::move(seen)] {
    FirstLook first{of, {}};
    for (const auto& [frame, area] : seen) {
      std::optional<CameraLook>& look = first.looks.emplace_back();
      if (frame.signal.empty()) continue;
      look.emplace();
      look->frame = frame;
      look->check = image::checkPhotograph(frame.signal, saturation, dark);
      look->sharpness = sharpness(frame.signal, area);
    }
    return first;
  });
}

void CameraPage::watch(std::size_t camera, const image::Region& area) {
  if (camera >= cameras_.size()) cameras_.resize(camera + 1);
  cameras_[camera].area = area;
  cameras_[camera].best = 0.0;
  if (shared_) {
    QMutexLocker lock(&shared_->guard);
    if (camera < shared_->cameras.size()) shared_->cameras[camera].area = area;
  }
  tellSettings();
}

void CameraPage::chooseExposure(std::size_t index) {
  if (!mayChooseExposure()) return tellSettings();
  // Noise looks sharp: that of another exposure is no mark for this one.
  if (std::exchange(exposure_, index) != index) forgetBest();
  if (shared_) {
    QMutexLocker lock(&shared_->guard);
    shared_->exposure = index;
  }
  tellSettings();
}

void CameraPage::start() {
  if (needsCamera() || !session_.areDevicesFree()) return;
  // The checks go from black to white and back.
  waitsForConsent_ = !session_.mayMeasure();
  if (waitsForConsent_) {
    forgetChecks();
    return tellAll();
  }
  goOn_ = false;
  isChecking_ = true;
  forgetChecks();
  shared_ = std::make_shared<Shared>();
  cameras_.resize(std::max(cameras_.size(), cameras()));
  for (const Watched& camera : cameras_) shared_->cameras.push_back({.area = camera.area});
  lease_ = session_.leaseDevices(stepName, DeviceWork::light, [this] {
    if (!isChecking_) return;  // the light that follows the checks stands still
    startsAgain_ = true;
    finish();
  });
  job_.start([this, shared = shared_, work = workOf(session_), settings = session_.settings().acquisition,
              unit = exposureUnit()](Progress& progress) {
    Progress opening = progress.part(0.1, RELUCENT_MESSAGE("stage.opening-devices", "Opening the devices"));
    rig::Rig& rig = work.devices->openUnproved(opening);
    if (work.devices->hasScreen()) {
      Progress first =
          progress.part(0.1, RELUCENT_MESSAGE("stage.looking-through-camera", "Looking through the camera"));
      work.devices->lookFirst(first);
      Progress proving = progress.part(
          0.2, RELUCENT_MESSAGE("stage.finding-projector-picture", "Looking for the projector's picture"));
      work.devices->open(proving);
      Progress checking = progress.part(
          0.3, RELUCENT_MESSAGE("stage.checking-projector-and-camera", "Checking projector and camera"));
      pipeline::RigCheck check = work.devices->check(checking);
      QMutexLocker lock(&shared->guard);
      shared->check = std::move(check);
    }
    rig::NoShotLog nothing;
    rig::ShotTaker shots(rig, nothing, "camera");
    Progress exposing =
        progress.part(0.2, RELUCENT_MESSAGE("stage.finding-exposures", "Finding the exposures"));
    linearization::ExposureChoice choice = linearization::chooseExposures(shots, exposing, unit);
    std::vector<pipeline::PixelForecast> pixels =
        pipeline::pixelForecasts(rig, choice, shots.times(), settings, platform::memoryLeft());
    Progress covering = progress.part(
        0.1, RELUCENT_MESSAGE("stage.finding-what-is-seen", "Finding which part of the picture is seen"));
    linearization::RigCoverage coverage = linearization::coverageOf(shots, choice.flood.front(), covering);
    // A large camera's photographs would take up the memory that measuring needs.
    choice.whites.clear();
    choice.black = {};
    {
      QMutexLocker lock(&shared->guard);
      shared->pixels = std::move(pixels);
      shared->coverage = std::move(coverage);
      shared->cameras.resize(rig.cameras.size());
      shared->choice = choice;
      // The one between bright parts and shadows.
      shared->exposure = choice.seconds.size() / 2;
      for (std::size_t camera = 0; camera < rig.cameras.size(); ++camera)
        if (shared->cameras[camera].area == image::Region{})
          shared->cameras[camera].area = centre(rig.cameras[camera]->size());
    }
    Progress looking =
        progress.part(0.0, RELUCENT_MESSAGE("stage.looking-through-camera", "Looking through the camera"));
    linearization::showEven(rig, {1, 1, 1});
    for (int number = shots.shots();; ++number) {
      looking.checkpoint();
      QElapsedTimer since;
      since.start();
      for (std::size_t camera = 0; camera < rig.cameras.size(); ++camera) {
        looking.checkpoint();
        std::size_t exposure = 0;
        image::Region area;
        {
          QMutexLocker lock(&shared->guard);
          const Watched& watched = shared->cameras[camera];
          exposure = std::min(shared->exposure, choice.seconds.size() - 1);
          area = watched.area;
          // The ends are looked at first: they tell what no exposure covers.
          if (!watched.tooBright)
            exposure = choice.seconds.size() - 1;
          else if (!watched.tooDark)
            exposure = 0;
        }
        CameraLook look;
        look.frame = rig.cameras[camera]->capture({{"camera", number}, 0, choice.seconds[exposure]});
        look.check = image::checkPhotograph(look.frame.signal, saturation, dark);
        look.sharpness = sharpness(look.frame.signal, area);
        look.exposure = exposure;
        QMutexLocker lock(&shared->guard);
        Watched& watched = shared->cameras[camera];
        if (exposure + 1 == choice.seconds.size()) watched.tooBright = look.check.tooBright;
        if (exposure == 0) watched.tooDark = look.check.tooDark;
        watched.look = std::move(look);
      }
      QMutexLocker lock(&shared->guard);
      if (!std::exchange(shared->posted, true))
        QMetaObject::invokeMethod(this, [this] { takeSharedState(); }, Qt::QueuedConnection);
      lock.unlock();
      // Twice a second: the screen's own light falls into the room.
      while (since.elapsed() < 500) {
        looking.checkpoint();
        QThread::msleep(restMilliseconds);
      }
    }
  });
  tellResult();
}

void CameraPage::takeSharedState() {
  if (!shared_) return;
  {
    QMutexLocker lock(&shared_->guard);
    shared_->posted = false;
    if (shared_->choice) {
      exposures_ = *std::exchange(shared_->choice, std::nullopt);
      pixels_ = shared_->pixels;
      rigCoverage_ = *shared_->coverage;
      coverage_ = rigCoverage_.byAnyCamera();
      exposure_ = shared_->exposure;
      isChecking_ = false;
    }
    if (shared_->check) check_ = std::exchange(shared_->check, std::nullopt);
    cameras_.resize(std::max(cameras_.size(), shared_->cameras.size()));
    for (std::size_t camera = 0; camera < shared_->cameras.size(); ++camera) {
      const Watched& seen = shared_->cameras[camera];
      cameras_[camera].tooBright = seen.tooBright;
      cameras_[camera].tooDark = seen.tooDark;
      cameras_[camera].area = seen.area;
      if (seen.look) cameras_[camera].look = seen.look;
    }
  }
  learnBest();
  tellAll();
}

/// Of looks with the exposure that is looked with.
void CameraPage::learnBest() {
  for (Watched& camera : cameras_)
    if (camera.look && camera.look->exposure == exposure_)
      camera.best = std::max(camera.best, camera.look->sharpness);
}

void CameraPage::ended() {
  takeSharedState();
  isChecking_ = false;
  // What was chosen last may not have been looked with any more: the picture that stays says which one was.
  if (look() && look()->exposure) exposure_ = *look()->exposure;
  lease_.release();
  if (job_.state() == Job::State::failed)
    Q_EMIT failed({job_.failure(), tr("Nothing is measured at this step, so nothing is lost.")});
  if (std::exchange(goOn_, false)) keepLook();
  if (std::exchange(startsAgain_, false)) return start();
  tellResult();
}

void CameraPage::keepLook() {
  calibration::CameraCheckResult kept;
  kept.exposures = exposures_.seconds;
  for (std::size_t camera = 0; camera < cameras(); ++camera)
    kept.tooBright = std::max(kept.tooBright, tooBrightEverywhere(camera).value_or(0.0));
  if (check_) {
    kept.latencySeconds = check_->latency.seconds;
    for (const devices::CheckVerdict& verdict : pipeline::verdictsOf(*check_))
      kept.verdicts.push_back(devices::messageOf(verdict));
  }
  try {
    session_.decide(kept);
    Q_EMIT nextWanted();
  } catch (...) {
    Q_EMIT failed({failureOf(std::current_exception()), tr("Nothing was changed.")});
  }
}

}  // namespace relucent::gui
