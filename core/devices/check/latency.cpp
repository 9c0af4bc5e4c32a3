// SPDX-License-Identifier: MIT
#include "relucent/devices/check/latency.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>

#include "relucent/base/error.h"

namespace relucent::devices {
namespace {

/// A white that is less brighter than black than this share of full scale is not seen.
constexpr double leastStep = 0.02;

class LatencyMeasurement {
 public:
  LatencyMeasurement(rig::Projector& projector, rig::Camera& camera, double exposure,
                     const LatencySettings& settings, const Wait& wait, Progress& progress)
      : projector_(projector),
        camera_(camera),
        exposure_(exposure),
        settings_(settings),
        wait_(wait),
        progress_(progress),
        black_(projector.size(), 3, 0.0f),
        white_(projector.size(), 3, 1.0f) {}

  Latency run() {
    Latency latency;
    measureLevels(latency);
    if (!suffices(settings_.mostFrames))
      throw Error(ErrorKind::device,
                  RELUCENT_MESSAGE("device.picture-not-settled",
                                   "a new picture has not fully appeared after {} frames")
                      .with(settings_.mostFrames),
                  RELUCENT_MESSAGE("device.steady-view-and-expose-briefly",
                                   "check that the camera's view is steady and its exposure short, and "
                                   "switch the projector's smoothing of motion off"),
                  projector_.name());
    int least = -1, enough = settings_.mostFrames;  // the first does not suffice, the second does
    while (enough - least > 1) {
      const int middle = (least + enough) / 2;
      (suffices(middle) ? enough : least) = middle;
      progress_.report(1.0 - static_cast<double>(enough - least) / (settings_.mostFrames + 1));
    }
    latency.frames = enough;
    latency.seconds = (enough + 1) * settings_.frame;
    speak(latency);
    return latency;
  }

 private:
  double photograph() {
    progress_.checkpoint();
    return meanSignal(camera_.capture({{"latency", number_++}, 0, exposure_}));
  }

  void settle(const image::Image& picture) {
    projector_.show(picture);
    wait_(settings_.mostFrames * settings_.frame);
  }

  void measureLevels(Latency& latency) {
    settle(black_);
    blackLevel_ = photograph();
    settle(white_);
    std::vector<double> levels;
    for (int i = 0; i < std::max(4, settings_.repeats); ++i) levels.push_back(photograph());
    for (double level : levels) whiteLevel_ += level / static_cast<double>(levels.size());
    double variance = 0.0;
    for (double level : levels)
      variance += std::pow(level - whiteLevel_, 2.0) / static_cast<double>(levels.size() - 1);
    latency.step = whiteLevel_ - blackLevel_;
    if (!(latency.step > leastStep))
      throw Error(
          ErrorKind::device,
          RELUCENT_MESSAGE("device.no-contrast", "the camera sees no difference between white and black"),
          RELUCENT_MESSAGE("device.aim-uncover-and-expose-longer",
                           "aim it at the projection, take off its lens cap, and expose longer"),
          camera_.name());
    latency.flicker = std::sqrt(variance) / whiteLevel_;
  }

  bool suffices(int frames) {
    for (int i = 0; i < settings_.repeats; ++i) {
      if (!seesStep(black_, blackLevel_, white_, whiteLevel_, frames)) return false;
      if (!seesStep(white_, whiteLevel_, black_, blackLevel_, frames)) return false;
    }
    return true;
  }

  bool seesStep(const image::Image& from, double fromLevel, const image::Image& to, double toLevel,
                int frames) {
    settle(from);
    // A fraction of a frame that differs each time: steps must not always fall on the same phase.
    wait_(settings_.frame * std::fmod(0.382 * ++steps_, 1.0));
    projector_.show(to);
    wait_(frames * settings_.frame);
    const double seen = (photograph() - fromLevel) / (toLevel - fromLevel);
    return std::abs(1.0 - seen) <= settings_.settled;
  }

  void speak(Latency& latency) const {
    latency.verdicts.push_back(
        {.finding = Finding::pictureOut, .count = latency.frames, .seconds = latency.seconds});
    if (latency.flicker > settings_.flicker)
      latency.verdicts.push_back(
          {.finding = Finding::whiteChanges, .share = latency.flicker, .frame = settings_.frame});
  }

  rig::Projector& projector_;
  rig::Camera& camera_;
  double exposure_;
  const LatencySettings& settings_;
  const Wait& wait_;
  Progress& progress_;
  image::Image black_, white_;
  double blackLevel_ = 0.0, whiteLevel_ = 0.0;
  int number_ = 0;
  int steps_ = 0;
};

class DelayedProjector : public rig::Projector {
 public:
  DelayedProjector(std::unique_ptr<rig::Projector> projector, double seconds, Wait wait)
      : projector_(std::move(projector)), seconds_(seconds), wait_(std::move(wait)) {}

  std::string name() const override { return projector_->name(); }
  Size size() const override { return projector_->size(); }
  int bits() const override { return projector_->bits(); }
  void show(const image::Image& encodedDrive) override {
    projector_->show(encodedDrive);
    wait_(seconds_);
  }

 private:
  std::unique_ptr<rig::Projector> projector_;
  double seconds_;
  Wait wait_;
};

}  // namespace

std::vector<Message> problems(const LatencySettings& settings) {
  std::vector<Message> found;
  if (!(settings.frame > 0.0))
    found.push_back(RELUCENT_ENGLISH_MESSAGE("device.frame-time-not-positive",
                                             "the duration of a projector's frame must be above 0 seconds"));
  if (settings.mostFrames < 1)
    found.push_back(
        RELUCENT_ENGLISH_MESSAGE("device.latency-frames-not-positive", "a picture needs at least one frame"));
  if (settings.repeats < 1)
    found.push_back(RELUCENT_ENGLISH_MESSAGE("device.latency-repeats-not-positive",
                                             "a step must be tried at least once"));
  if (!(settings.settled > 0.0 && settings.settled < 0.5))
    found.push_back(
        RELUCENT_ENGLISH_MESSAGE("device.settled-share-out-of-range",
                                 "the share of a step that may be missing is between 0 and a half"));
  return found;
}

Latency measureLatency(rig::Projector& projector, rig::Camera& camera, double exposure,
                       const LatencySettings& settings, const Wait& wait, Progress& progress) {
  require(problems(settings).empty(), "{}", fmt::join(problems(settings), "; "));
  require(exposure > 0.0, "an exposure of {} s", exposure);
  return LatencyMeasurement(projector, camera, exposure, settings, wait, progress).run();
}

void sleepFor(double seconds) {
  std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
}

double meanSignal(const rig::RawFrame& frame) {
  double sum = 0.0;
  for (float value : frame.signal.data()) sum += static_cast<double>(value);
  return sum / static_cast<double>(frame.signal.data().size());
}

std::unique_ptr<rig::Projector> delayed(std::unique_ptr<rig::Projector> projector, double seconds,
                                        Wait wait) {
  return std::make_unique<DelayedProjector>(std::move(projector), seconds, std::move(wait));
}

}  // namespace relucent::devices
