// SPDX-License-Identifier: MIT
// The only file that knows OpenCV's cameras.
#include <filesystem>
#include <opencv2/videoio.hpp>
#include <thread>

#include "relucent/devices/video/video_source.h"

namespace relucent::devices {
namespace {

using std::chrono::microseconds;

int propertyOf(VideoControl control) {
  switch (control) {
    case VideoControl::exposureMode:
      return cv::CAP_PROP_AUTO_EXPOSURE;
    case VideoControl::exposure:
      return cv::CAP_PROP_EXPOSURE;
    case VideoControl::automaticWhiteBalance:
      return cv::CAP_PROP_AUTO_WB;
    case VideoControl::automaticFocus:
      return cv::CAP_PROP_AUTOFOCUS;
    case VideoControl::gain:
      return cv::CAP_PROP_GAIN;
  }
  return -1;
}

class OpenCvVideoSource : public VideoSource {
 public:
  explicit OpenCvVideoSource(std::string path) : path_(std::move(path)) {}

  bool exists() const override {
    std::error_code code;
    return std::filesystem::exists(path_, code);
  }
  bool open(std::optional<Size> size) override try {
    // Names of links are not understood everywhere.
    std::error_code code;
    const std::filesystem::path device = std::filesystem::canonical(path_, code);
    if (code || !capture_.open(device.string(), cv::CAP_V4L2)) return false;
    capture_.set(cv::CAP_PROP_BUFFERSIZE, 1);
    if (size) {
      capture_.set(cv::CAP_PROP_FRAME_WIDTH, size->width);
      capture_.set(cv::CAP_PROP_FRAME_HEIGHT, size->height);
    }
    return true;
  } catch (const cv::Exception&) {
    return false;
  }
  void close() noexcept override { capture_.release(); }
  bool set(VideoControl control, double value) override { return capture_.set(propertyOf(control), value); }
  std::optional<double> get(VideoControl control) override {
    const double value = capture_.get(propertyOf(control));
    if (value < 0.0) return std::nullopt;  // what OpenCV says of a control that is missing
    return value;
  }
  std::optional<VideoFrame> grab() override try {
    if (!capture_.read(image_) || image_.empty() || image_.type() != CV_8UC3) return std::nullopt;
    VideoFrame frame{{image_.cols, image_.rows}, {}, std::nullopt};
    for (int y = 0; y < image_.rows; ++y)
      frame.bgr.insert(frame.bgr.end(), image_.ptr(y), image_.ptr(y) + 3 * image_.cols);
    const double milliseconds = capture_.get(cv::CAP_PROP_POS_MSEC);
    if (milliseconds > 0.0) frame.captured = microseconds(static_cast<std::int64_t>(milliseconds * 1000.0));
    return frame;
  } catch (const cv::Exception&) {
    return std::nullopt;
  }
  microseconds now() const override {
    // The clock that Video4Linux stamps frames with.
    return std::chrono::duration_cast<microseconds>(std::chrono::steady_clock::now().time_since_epoch());
  }
  void wait(microseconds time) override { std::this_thread::sleep_for(time); }

 private:
  std::string path_;
  cv::VideoCapture capture_;
  cv::Mat image_;
};

}  // namespace

std::unique_ptr<VideoSource> openCvVideoSource(const std::string& path) {
  return std::make_unique<OpenCvVideoSource>(path);
}

}  // namespace relucent::devices
