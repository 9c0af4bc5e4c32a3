// SPDX-License-Identifier: MIT
#include "output/show_photography.h"

#include <utility>

#include "jobs/live_rig.h"
#include "output/screen_identity.h"
#include "output/show_nights.h"
#include "output/window_projector.h"
#include "relucent/base/error.h"
#include "relucent/base/utc.h"
#include "relucent/pipeline/devices.h"
#include "relucent/pipeline/screen_devices.h"
#include "relucent/pipeline/stored_settings.h"
#include "relucent/pipeline/warm_up.h"
#include "relucent/rig/watched_rig.h"

namespace relucent::gui {
namespace {

constexpr int betweenPictures = 1000 / 3;  // milliseconds

using calibration::CalibrationFolder;

/// Why this rig photographs no show; empty: it does.
struct WhyNot {
  Message operator()(const venue::VenueSettings&) const { return {}; }
  Message operator()(const pipeline::ScreenRigSettings& rig) const {
    return pipeline::camerasOf(rig).empty() ? noCamera() : Message();
  }
  Message operator()(const pipeline::CommandRigSettings&) const {
    return RELUCENT_MESSAGE(
        "show.projector-by-command",
        "this calibration shows pictures by a command of its own, which does not know of the "
        "show: stop the show and use relucent-cli verify and perfect");
  }
  Message operator()(const pipeline::ReplayRigSettings&) const { return noCamera(); }
  Message operator()(const pipeline::ImportedRigSettings&) const { return noCamera(); }

  static Message noCamera() {
    return RELUCENT_MESSAGE("show.no-camera", "this show has no camera: its calibration names none");
  }
};

class CalibratedPhotography : public ShowPhotography {
 public:
  CalibratedPhotography(std::filesystem::path calibration, std::filesystem::path cache,
                        pjlink::Waiting waiting)
      : calibration_(std::move(calibration)), cache_(std::move(cache)), waiting_(std::move(waiting)) {}

  Message whyNot() const override {
    try {
      return std::visit(WhyNot(), rig());
    } catch (const Error& error) {
      return error.sentence();
    }
  }
  pipeline::VerifyResult check(Progress& progress) override {
    Devices devices(*this, progress);
    return pipeline::verifyCalibration(calibration_, {}, devices.rig(), progress);
  }
  pipeline::PerfectedImage perfect(const std::filesystem::path& picture, const Canvas& canvas,
                                   const std::string& set, Progress& progress) override {
    Devices devices(*this, progress);
    pipeline::PerfectSettings settings;
    settings.images = {picture};
    settings.canvas = {{canvas.size.width(), canvas.size.height()}, canvas.fit};
    settings.set = set;
    pipeline::PerfectResult result = perfectPictures(
        calibration_, settings, devices.rig(), [](std::size_t, const pipeline::PerfectingRound&) {},
        progress);
    return std::move(result.images.front());
  }
  pipeline::NightRecord tend(const pipeline::NightSettings& work, bool switchesOn,
                             Progress& progress) override {
    std::optional<Devices> devices;
    pipeline::NightRecord night;
    night.when = work.when.empty() ? utcNow() : work.when;
    try {
      const pipeline::CalibrateSettings settings =
          pipeline::settingsOf(CalibrationFolder::open(calibration_, CalibrationFolder::Access::read));
      pipeline::ProjectorWarmUp warmUp(switchesOn ? settings.network : pipeline::NetworkProjectors(),
                                       settings.rig, waiting_);
      warmUp.switchOn(progress);
      devices.emplace(*this, progress);
      warmUp.awaitSteadyLight(devices->rig(), progress);
    } catch (const Error& error) {
      night.alarm = error.sentence();
      pipeline::closeNight(calibration_, night, work.alarmCommand);
      return night;
    }
    return pipeline::tendCalibration(calibration_, work, devices->rig(), progress);
  }

 private:
  /// Open for as long as this lives.
  class Devices {
   public:
    Devices(const CalibratedPhotography& of, Progress& progress) : live_(std::make_shared<LiveRig>()) {
      Progress opening = progress.part(0.2, RELUCENT_MESSAGE("stage.opening-devices", "Opening the devices"));
      opened_ = pipeline::openRig(
          of.rig(), of.cache_,
          [](const pipeline::ScreenRigSettings& screen) {
            return std::make_unique<WindowProjector>(identityOf(screen.display), screen.projector);
          },
          opening);
      if (opened_.screen) live_->setLeastInterval(betweenPictures);
      opened_.rig = rig::watched(std::move(opened_.rig), live_);
    }
    rig::Rig& rig() { return opened_.rig; }

   private:
    std::shared_ptr<LiveRig> live_;
    pipeline::OpenedRig opened_;
  };

  pipeline::RigSettings rig() const {
    return pipeline::settingsOf(CalibrationFolder::open(calibration_, CalibrationFolder::Access::read)).rig;
  }

  std::filesystem::path calibration_, cache_;
  pjlink::Waiting waiting_;
};

Message sentenceOf(const pipeline::PerfectedImage& image) {
  if (!image.failure.empty()) return image.failure;
  if (!image.disturbance.empty()) return image.disturbance;
  return image.kept
             ? RELUCENT_ENGLISH_MESSAGE("show.picture-perfected",
                                        "the picture is better than it was, and shown so")
             : RELUCENT_ENGLISH_MESSAGE("show.picture-as-before",
                                        "photographs found nothing to better: the picture stays as it was");
}

}  // namespace

std::unique_ptr<ShowPhotography> photographyOf(const std::filesystem::path& calibration,
                                               const std::filesystem::path& cache, pjlink::Waiting waiting) {
  return std::make_unique<CalibratedPhotography>(calibration, cache, std::move(waiting));
}

ShowPhotographs::ShowPhotographs(std::unique_ptr<ShowPhotography> photography, QObject* parent)
    : QObject(parent), photography_(std::move(photography)) {
  connect(&job_, &Job::progressed, this,
          [this](double fraction, const QString& stage) { Q_EMIT progressed(work_, fraction, stage); });
  connect(&job_, &Job::ended, this, &ShowPhotographs::finished);
}

Message ShowPhotographs::whyNot() const {
  if (isRunning())
    return RELUCENT_ENGLISH_MESSAGE("show.photographs-already",
                                    "photographs are being taken already: wait for their end");
  return photography_->whyNot();
}

void ShowPhotographs::start(const QString& work, std::function<Found(Progress&)> job) {
  work_ = work;
  found_ = std::make_shared<Found>();
  job_.start([found = found_, camera = camera_, job = std::move(job)](Progress& progress) {
    if (camera) camera->awaitFree(progress);
    *found = job(progress);
  });
}

void ShowPhotographs::check() {
  start("check", [photography = photography_](Progress& progress) {
    const pipeline::VerifyResult result = photography->check(progress);
    return Found{QString::fromStdString(std::string(toString(result.judgement.verdict))),
                 result.judgement.sentence};
  });
}

void ShowPhotographs::perfect(const std::filesystem::path& picture, const Canvas& canvas,
                              const std::string& set) {
  start("perfect", [photography = photography_, picture, canvas, set](Progress& progress) {
    const pipeline::PerfectedImage image = photography->perfect(picture, canvas, set, progress);
    const bool failed = !image.failure.empty() || !image.disturbance.empty();
    return Found{failed ? "failed" : image.kept ? "better" : "as_before", sentenceOf(image)};
  });
}

void ShowPhotographs::tend(const pipeline::NightSettings& work, bool switchesOn) {
  start("night", [photography = photography_, work, switchesOn](Progress& progress) {
    const pipeline::NightRecord night = photography->tend(work, switchesOn, progress);
    return Found{isAlarm(night) ? "alarm" : "well", sentenceOf(night)};
  });
}

void ShowPhotographs::cancel() {
  job_.disconnect(this);
  job_.cancel();
  job_.wait();
}

void ShowPhotographs::finished() {
  const std::shared_ptr<Found> found = std::exchange(found_, nullptr);
  switch (job_.state()) {
    case Job::State::done:
      return Q_EMIT ended(work_, found->verdict, QString::fromStdString(englishSentence(found->sentence)));
    case Job::State::failed:
      return Q_EMIT ended(work_, "failed", (job_.failure().what + " " + job_.failure().advice).trimmed());
    default:
      return Q_EMIT ended(work_, "failed", "stopped on request");
  }
}

}  // namespace relucent::gui
