// SPDX-License-Identifier: MIT
#include "relucent/devices/screen_rig.h"

#include <atomic>
#include <optional>

#include "relucent/base/error.h"
#include "relucent/devices/whole_frames.h"

namespace relucent::devices {
namespace {

constexpr int mostAttempts = 20;  // at one photograph

/// What both devices share: the screen, and the picture that should stand on it.
class SharedScreen : public ScreenControl {
 public:
  SharedScreen(std::unique_ptr<ScreenProjector> screen, const ScreenTiming& timing, Wait wait)
      : screen_(std::move(screen)), frame_(timing.frame), latency_(timing.latency), wait_(std::move(wait)) {}

  void setLatency(double seconds) override { latency_ = seconds; }
  void rest() override { screen_->rest(); }
  void setWholeFrames(bool whole) override { whole_ = whole; }
  rig::ExposureRange exposures(const rig::ExposureRange& range) const {
    return whole_ ? wholeFramesIn(range, frame_) : range;
  }
  double exposure(double seconds, const rig::ExposureRange& range) const {
    return whole_ && hasWholeFrames(range, frame_) ? wholeFrames(seconds, frame_, range) : seconds;
  }

  void show(const image::Image& picture) {
    picture_ = picture;
    showAgain();
  }
  void showAgain() {
    screen_->show(*picture_);
    if (latency_ > 0.0) wait_(latency_);
  }
  /// Nothing shown is nothing lost.
  bool stayedVisible() { return !picture_ || screen_->stayedVisible(); }
  const ScreenProjector& screen() const { return *screen_; }

 private:
  std::unique_ptr<ScreenProjector> screen_;
  double frame_;
  std::atomic<double> latency_;
  std::atomic<bool> whole_ = true;
  Wait wait_;
  std::optional<image::Image> picture_;
};

class TimedProjector : public rig::Projector {
 public:
  explicit TimedProjector(std::shared_ptr<SharedScreen> shared) : shared_(std::move(shared)) {}

  std::string name() const override { return shared_->screen().name(); }
  Size size() const override { return shared_->screen().size(); }
  int bits() const override { return shared_->screen().bits(); }
  void show(const image::Image& encodedDrive) override { shared_->show(encodedDrive); }

 private:
  std::shared_ptr<SharedScreen> shared_;
};

class ScreenCheckingCamera : public rig::Camera {
 public:
  ScreenCheckingCamera(std::unique_ptr<rig::Camera> camera, std::shared_ptr<SharedScreen> shared)
      : camera_(std::move(camera)), shared_(std::move(shared)) {}

  std::string name() const override { return camera_->name(); }
  Size size() const override { return camera_->size(); }
  rig::ExposureRange exposures() const override { return shared_->exposures(camera_->exposures()); }
  rig::RawFrame capture(const rig::CaptureRequest& asked) override {
    rig::CaptureRequest request = asked;
    request.seconds = shared_->exposure(asked.seconds, camera_->exposures());
    for (int attempt = 0; attempt < mostAttempts; ++attempt) {
      // It may have gone while nobody looked.
      if (!shared_->stayedVisible()) shared_->showAgain();
      rig::RawFrame frame = camera_->capture(request);
      if (shared_->stayedVisible()) return frame;
    }
    throw Error(
        ErrorKind::device,
        RELUCENT_MESSAGE("device.screen-loses-picture", "the projector's screen keeps losing its picture"),
        RELUCENT_MESSAGE("device.check-cable-and-power-saving",
                         "check its cable, and switch off its power saving"),
        shared_->screen().name());
  }

 private:
  std::unique_ptr<rig::Camera> camera_;
  std::shared_ptr<SharedScreen> shared_;
};

}  // namespace

ScreenRig screenRig(std::unique_ptr<ScreenProjector> screen, std::unique_ptr<rig::Camera> camera,
                    const ScreenTiming& timing, Wait wait) {
  require(screen != nullptr && camera != nullptr, "a screen and a camera are needed");
  auto shared = std::make_shared<SharedScreen>(std::move(screen), timing, std::move(wait));
  ScreenRig result;
  result.rig.projectors.push_back(std::make_unique<TimedProjector>(shared));
  result.rig.cameras.push_back(std::make_unique<ScreenCheckingCamera>(std::move(camera), shared));
  result.control = std::move(shared);
  return result;
}

}  // namespace relucent::devices
