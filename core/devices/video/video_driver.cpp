// SPDX-License-Identifier: MIT
#include "relucent/devices/video/video_driver.h"

#include <algorithm>
#include <cmath>

#include "relucent/base/error.h"

namespace relucent::devices {
namespace {

using std::chrono::microseconds;

constexpr double secondsPerUnit = 1e-4;
constexpr double manual = 1.0;
/// Ends of the range that are tried, in units; the device cuts them to its own.
constexpr double shortestTried = 1.0;
constexpr double longestTried = 10000.0;
/// Frames that a system may hold ready, and the one that is under way. Without time stamps all count as old.
constexpr int framesInTheQueue = 5;
/// Between two looks for a picture that does not come.
constexpr microseconds pause{10'000};
/// A stamp is of the right clock if it lies within this of now.
constexpr microseconds believable{60'000'000};

class VideoDriver : public CameraDriver {
 public:
  VideoDriver(std::unique_ptr<VideoSource> source, std::string name, std::optional<Size> size)
      : source_(std::move(source)), name_(std::move(name)), size_(size) {}

  std::string name() const override { return name_; }

  CameraTraits connect() override {
    disconnect();
    if (!source_->exists())
      throw CameraLost(RELUCENT_MESSAGE("device.video-device-missing", "no such video device is plugged in"));
    if (!source_->open(size_))
      throw CameraLost(
          RELUCENT_MESSAGE("device.video-device-in-use",
                           "the video device cannot be opened: another program may be using it"));
    switchOff(VideoControl::exposureMode, manual,
              RELUCENT_MESSAGE("device.automatic-exposure-stays",
                               "the video device's automatic exposure cannot be switched off"));
    switchOff(VideoControl::automaticWhiteBalance, 0.0,
              RELUCENT_MESSAGE("device.automatic-white-balance-stays",
                               "the video device's automatic white balance cannot be switched off"));
    switchOff(VideoControl::automaticFocus, 0.0,
              RELUCENT_MESSAGE("device.automatic-focus-stays",
                               "the video device's automatic focus cannot be switched off"));

    CameraTraits traits;
    traits.model = "video device";
    traits.format = {SensorLayout::bgr, 8};
    traits.gain = source_->get(VideoControl::gain).value_or(0.0);
    const double longest = setExposure(longestTried * secondsPerUnit);
    traits.exposures = {setExposure(shortestTried * secondsPerUnit), longest};
    const std::optional<VideoFrame> first = source_->grab();
    if (!first)
      throw CameraLost(RELUCENT_MESSAGE("device.no-video-pictures", "the video device sends no pictures"));
    traits.size = first->size;
    if (size_ && first->size != *size_)
      throw Error(
          ErrorKind::device,
          RELUCENT_MESSAGE("device.video-size-refused", "{} pixels are wanted and the video device gives {}")
              .with(as::size(*size_), as::size(first->size)),
          RELUCENT_MESSAGE("device.ask-for-listed-size",
                           "ask for a size that it has: v4l2-ctl --list-formats-ext names them"),
          name_);
    isStamped_ = hasStamp(*first);
    if (!isStamped_)
      traits.remarks.push_back(RELUCENT_MESSAGE(
          "device.no-capture-times",
          "does not say when pictures were captured: some are dropped before each photograph"));
    traits.remarks.push_back(
        RELUCENT_MESSAGE("device.delivers-8-bits", "delivers 8 bits: dark places stay uncertain"));
    return traits;
  }

  void disconnect() noexcept override { source_->close(); }

  double setExposure(double seconds) override {
    source_->set(VideoControl::exposure, std::max(1.0, std::round(seconds / secondsPerUnit)));
    // Whether it was accepted shows in what is there afterwards, not in what set() says.
    const std::optional<double> held = source_->get(VideoControl::exposure);
    if (!held) {
      checkPresence();
      throw Error(ErrorKind::device,
                  RELUCENT_MESSAGE("device.video-exposure-not-settable",
                                   "the video device has no exposure that can be set"),
                  RELUCENT_MESSAGE("device.use-manual-exposure-camera", "use a camera with manual exposure"),
                  name_);
    }
    return *held * secondsPerUnit;
  }

  void trigger() override {
    if (isStamped_) return;
    for (int i = 0; i < framesInTheQueue; ++i) source_->grab();
  }

  std::optional<DriverFrame> next(microseconds time) override {
    const microseconds deadline = source_->now() + time;
    do {
      std::optional<VideoFrame> grabbed = source_->grab();
      if (!grabbed) {
        checkPresence();
        source_->wait(pause);
        continue;
      }
      DriverFrame frame;
      frame.arrived = isStamped_ && grabbed->captured ? *grabbed->captured : source_->now();
      frame.id = isStamped_ ? static_cast<std::uint64_t>(frame.arrived.count()) : ++count_;
      frame.frame = {grabbed->size, {SensorLayout::bgr, 8}, std::move(grabbed->bgr)};
      return frame;
    } while (source_->now() < deadline);
    return std::nullopt;
  }

  void restart() override {
    if (!source_->open(size_))
      throw CameraLost(
          RELUCENT_MESSAGE("device.cannot-reopen-video-device", "the video device cannot be opened again"));
  }

  microseconds now() const override { return source_->now(); }
  void wait(microseconds time) override { source_->wait(time); }

 private:
  /// Throws: Error{device} that is `failure` if the device decides by itself all the same.
  void switchOff(VideoControl control, double off, const Message& failure) {
    const std::optional<double> before = source_->get(control);
    if (!before || *before == off) return;
    source_->set(control, off);
    if (source_->get(control) == off) return;
    throw Error(ErrorKind::device, failure,
                RELUCENT_MESSAGE(
                    "device.switch-off-with-v4l2-ctl",
                    "switch it off with v4l2-ctl (--list-ctrls names what it has), or use another camera"),
                name_);
  }

  void checkPresence() const {
    if (!source_->exists())
      throw CameraLost(
          RELUCENT_MESSAGE("device.video-device-unplugged", "the video device has been unplugged"));
  }

  bool hasStamp(const VideoFrame& frame) const {
    if (!frame.captured) return false;
    const microseconds age = source_->now() - *frame.captured;
    return age >= microseconds{0} && age < believable;
  }

  std::unique_ptr<VideoSource> source_;
  std::string name_;
  std::optional<Size> size_;
  bool isStamped_ = true;
  std::uint64_t count_ = 0;
};

}  // namespace

std::unique_ptr<CameraDriver> makeVideoDriver(std::unique_ptr<VideoSource> source, std::string name,
                                              std::optional<Size> size) {
  return std::make_unique<VideoDriver>(std::move(source), std::move(name), size);
}

DrivenCameraSettings videoPatience() {
  DrivenCameraSettings settings;
  settings.timeout = std::chrono::milliseconds(5000);
  settings.skipAfterChange = 3;
  settings.connectFor = std::chrono::milliseconds(0);  // nothing holds one longer than its program lives
  return settings;
}

}  // namespace relucent::devices
