// SPDX-License-Identifier: MIT
#include "relucent/devices/screen_rig.h"

#include <atomic>
#include <optional>

#include "relucent/base/error.h"
#include "relucent/devices/whole_frames.h"

namespace relucent::devices {
namespace {

constexpr int mostAttempts = 20;  // at one photograph

/// A screen, and the picture that should stand on it.
struct Standing {
  std::unique_ptr<ScreenProjector> screen;
  std::optional<image::Image> picture;
  /// Nothing shown is nothing lost.
  bool isLost() const { return picture && !screen->stayedVisible(); }
};

/// What all devices share: the screens.
class SharedScreens : public ScreenControl {
 public:
  SharedScreens(std::vector<std::unique_ptr<ScreenProjector>> screens, const ScreenTiming& timing, Wait wait)
      : frame_(timing.frame), latency_(timing.latency), wait_(std::move(wait)) {
    for (std::unique_ptr<ScreenProjector>& screen : screens) {
      require(screen != nullptr, "a screen is missing");
      screens_.push_back({std::move(screen), std::nullopt});
    }
  }

  void setLatency(double seconds) override { latency_ = seconds; }
  void rest() override {
    for (Standing& standing : screens_) standing.screen->rest();
  }
  void setWholeFrames(bool whole) override { whole_ = whole; }
  rig::ExposureRange exposures(const rig::ExposureRange& range) const {
    return whole_ ? wholeFramesIn(range, frame_) : range;
  }
  double exposure(double seconds, const rig::ExposureRange& range) const {
    return whole_ && hasWholeFrames(range, frame_) ? wholeFrames(seconds, frame_, range) : seconds;
  }

  void show(std::size_t screen, const image::Image& picture) {
    screens_[screen].picture = picture;
    screens_[screen].screen->show(picture);
    waitUntilOut();
  }
  /// The pictures that were lost are shown again.
  void showLost() {
    bool wasLost = false;
    for (Standing& standing : screens_) {
      if (!standing.isLost()) continue;
      standing.screen->show(*standing.picture);
      wasLost = true;
    }
    if (wasLost) waitUntilOut();
  }
  /// The first screen that lost its picture; nullptr: none has.
  const ScreenProjector* lost() const {
    for (const Standing& standing : screens_)
      if (standing.isLost()) return standing.screen.get();
    return nullptr;
  }
  const ScreenProjector& screen(std::size_t index) const { return *screens_[index].screen; }

 private:
  void waitUntilOut() {
    if (latency_ > 0.0) wait_(latency_);
  }

  std::vector<Standing> screens_;
  double frame_;
  std::atomic<double> latency_;
  std::atomic<bool> whole_ = true;
  Wait wait_;
};

class TimedProjector : public rig::Projector {
 public:
  TimedProjector(std::shared_ptr<SharedScreens> shared, std::size_t index)
      : shared_(std::move(shared)), index_(index) {}

  std::string name() const override { return shared_->screen(index_).name(); }
  Size size() const override { return shared_->screen(index_).size(); }
  int bits() const override { return shared_->screen(index_).bits(); }
  void show(const image::Image& encodedDrive) override { shared_->show(index_, encodedDrive); }

 private:
  std::shared_ptr<SharedScreens> shared_;
  std::size_t index_;
};

class ScreenCheckingCamera : public rig::Camera {
 public:
  ScreenCheckingCamera(std::unique_ptr<rig::Camera> camera, std::shared_ptr<SharedScreens> shared)
      : camera_(std::move(camera)), shared_(std::move(shared)) {}

  std::string name() const override { return camera_->name(); }
  Size size() const override { return camera_->size(); }
  rig::ExposureRange exposures() const override { return shared_->exposures(camera_->exposures()); }
  rig::RawFrame capture(const rig::CaptureRequest& asked) override {
    rig::CaptureRequest request = asked;
    request.seconds = shared_->exposure(asked.seconds, camera_->exposures());
    const ScreenProjector* lost = nullptr;
    for (int attempt = 0; attempt < mostAttempts; ++attempt) {
      // It may have gone while nobody looked.
      shared_->showLost();
      rig::RawFrame frame = camera_->capture(request);
      lost = shared_->lost();
      if (lost == nullptr) return frame;
    }
    throw Error(
        ErrorKind::device,
        RELUCENT_MESSAGE("device.screen-loses-picture", "the projector's screen keeps losing its picture"),
        RELUCENT_MESSAGE("device.check-cable-and-power-saving",
                         "check its cable, and switch off its power saving"),
        lost->name());
  }

 private:
  std::unique_ptr<rig::Camera> camera_;
  std::shared_ptr<SharedScreens> shared_;
};

}  // namespace

ScreenRig screenRig(std::vector<std::unique_ptr<ScreenProjector>> screens,
                    std::vector<std::unique_ptr<rig::Camera>> cameras, const ScreenTiming& timing,
                    Wait wait) {
  require(!screens.empty() && !cameras.empty(), "a screen and a camera are needed");
  const std::size_t count = screens.size();
  auto shared = std::make_shared<SharedScreens>(std::move(screens), timing, std::move(wait));
  ScreenRig result;
  for (std::size_t i = 0; i < count; ++i)
    result.rig.projectors.push_back(std::make_unique<TimedProjector>(shared, i));
  for (std::unique_ptr<rig::Camera>& camera : cameras) {
    require(camera != nullptr, "a camera is missing");
    result.rig.cameras.push_back(std::make_unique<ScreenCheckingCamera>(std::move(camera), shared));
  }
  result.control = std::move(shared);
  return result;
}

ScreenRig screenRig(std::unique_ptr<ScreenProjector> screen, std::unique_ptr<rig::Camera> camera,
                    const ScreenTiming& timing, Wait wait) {
  std::vector<std::unique_ptr<ScreenProjector>> screens;
  std::vector<std::unique_ptr<rig::Camera>> cameras;
  screens.push_back(std::move(screen));
  cameras.push_back(std::move(camera));
  return screenRig(std::move(screens), std::move(cameras), timing, std::move(wait));
}

}  // namespace relucent::devices
