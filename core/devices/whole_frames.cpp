// SPDX-License-Identifier: MIT
#include "relucent/devices/whole_frames.h"

#include <algorithm>
#include <cmath>

#include "relucent/base/error.h"

namespace relucent::devices {
namespace {

/// Numbers of frames, so that rounding does not decide at the ends of the range.
constexpr double slack = 1e-6;

double fewest(double frame, const rig::ExposureRange& range) {
  return std::max(1.0, std::ceil(range.shortest / frame - slack));
}
double most(double frame, const rig::ExposureRange& range) {
  return std::floor(range.longest / frame + slack);
}

class WholeFrameCamera : public rig::Camera {
 public:
  WholeFrameCamera(std::unique_ptr<rig::Camera> camera, double frame)
      : camera_(std::move(camera)), frame_(frame) {}

  std::string name() const override { return camera_->name(); }
  Size size() const override { return camera_->size(); }
  rig::ExposureRange exposures() const override { return wholeFramesIn(camera_->exposures(), frame_); }
  rig::RawFrame capture(const rig::CaptureRequest& request) override {
    rig::CaptureRequest rounded = request;
    rounded.seconds = wholeFrames(request.seconds, frame_, camera_->exposures());
    return camera_->capture(rounded);
  }

 private:
  std::unique_ptr<rig::Camera> camera_;
  double frame_;
};

}  // namespace

double wholeFrames(double seconds, double frame, const rig::ExposureRange& range) {
  require(frame > 0.0, "a frame of {} s", frame);
  const double least = fewest(frame, range), largest = most(frame, range);
  require(least <= largest, "no whole frame of {} s between {} and {} s", frame, range.shortest,
          range.longest);
  return std::clamp(std::round(seconds / frame), least, largest) * frame;
}

bool hasWholeFrames(const rig::ExposureRange& range, double frame) {
  require(frame > 0.0, "a frame of {} s", frame);
  return fewest(frame, range) <= most(frame, range);
}

rig::ExposureRange wholeFramesIn(const rig::ExposureRange& range, double frame) {
  if (!hasWholeFrames(range, frame)) return range;
  return {fewest(frame, range) * frame, most(frame, range) * frame};
}

std::unique_ptr<rig::Camera> inWholeFrames(std::unique_ptr<rig::Camera> camera, double frame) {
  if (!hasWholeFrames(camera->exposures(), frame)) return camera;
  return std::make_unique<WholeFrameCamera>(std::move(camera), frame);
}

}  // namespace relucent::devices
