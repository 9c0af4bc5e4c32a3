// SPDX-License-Identifier: MIT
#pragma once

#include <QtTest>
#include <atomic>
#include <chrono>
#include <filesystem>
#include <mutex>
#include <optional>
#include <string_view>
#include <thread>
#include <vector>

#include "gui/output/two_screens.h"
#include "relucent/devices/check/latency.h"
#include "relucent/devices/sensor_frame.h"
#include "relucent/pipeline/calibrate_settings.h"
#include "relucent/venue/device_faults.h"
#include "relucent/venue/venue.h"
#include "support/fake_gige_camera.h"
#include "support/screen_light.h"

/// A simulated venue behind real devices: the projector is a window on the second screen of an X server,
/// whose pixels are read from that screen; the camera is a GigE Vision one on a loopback network.
/// $RELUCENT_REAL_SIZES "256x192 160x120" makes it as large as wanted.
namespace relucent::gui {

/// Of the projector: frames so short that a test need not wait for light.
inline constexpr double frameRate = 1000.0;

inline Size sizeFrom(const QString& text) {
  const QStringList sides = text.split('x');
  return {sides.at(0).toInt(), sides.at(1).toInt()};
}

struct Sizes {
  Size projector{32, 24}, camera{28, 21};
};
inline Sizes wantedSizes() {
  const QStringList given = qEnvironmentVariable("RELUCENT_REAL_SIZES").split(' ', Qt::SkipEmptyParts);
  if (given.size() != 2) return {};
  return {sizeFrom(given[0]), sizeFrom(given[1])};
}

inline pipeline::CalibrateSettings simulatedSettings() {
  venue::VenueSettings venue;
  venue.name = "corner";
  venue.projector = wantedSizes().projector;
  venue.camera = wantedSizes().camera;
  if (venue.projector.width < 64) venue.pathsPerPixel = 32;
  pipeline::CalibrateSettings settings;
  settings.rig = venue;
  if (venue.projector.width < 64) {
    settings.linearization.levels = 9;
    settings.acquisition = acquisition::settingsOf(acquisition::AcquisitionMode::fast);
  }
  return settings;
}

/// A venue's light where the screen shines, photographed by a camera on the network.
class Room {
 public:
  Room(const venue::VenueSettings& settings, const std::filesystem::path& cache) : light_("DUMMY1") {
    Progress silent;
    venue_.emplace(settings, cache, silent);
    rig_ = venue_->rig([this](const rig::ShotId&) { return faultsNow(); });
    brightness_ = 8.0 / frameRate / wellExposed();
    test::FakeGigeSettings camera;
    camera.sensor = sensor();
    fake_ = std::make_unique<test::FakeGigeCamera>(
        camera, [this](const test::FakeGigeCamera::View& view) { look(view); });
  }
  ~Room() { fake_.reset(); }

  bool isRunning() const { return fake_->isRunning(); }
  test::FakeGigeCamera& camera() { return *fake_; }
  int photographs() const { return photographs_; }
  /// Seconds of the camera's that are one of the venue's: its exposures need not be waited for in full.
  double brightness() const { return brightness_; }
  /// Somebody bumps the camera: what it sees has moved by so many pixels to the right and down. 0: it is put
  /// back.
  void bump(double pixels) {
    std::lock_guard guard(lock_);
    bumped_ = pixels;
  }
  /// No photograph follows the one before in less.
  void setLeastInterval(std::chrono::milliseconds time) {
    std::lock_guard guard(lock_);
    leastInterval_ = time;
  }
  /// What shone while they were taken, one after the other: equal numbers for equal patterns.
  std::vector<std::size_t> patterns() const {
    std::lock_guard guard(lock_);
    return patterns_;
  }
  /// Which photograph comes next: what noise depends on.
  void expect(const rig::CaptureRequest& request) {
    std::lock_guard guard(lock_);
    request_ = request;
  }

 private:
  double wellExposed() {
    rig_.projectors[0]->show(image::Image(rig_.projectors[0]->size(), 3, 1.0f));
    double seconds = 1e-4;
    while (seconds < 10.0 && devices::meanSignal(rig_.cameras[0]->capture({{"try", 0}, 0, seconds})) < 0.3)
      seconds *= 1.3;
    return seconds;
  }

  Size sensor() const {
    return devices::sensorSize(rig_.cameras[0]->size(), {devices::SensorLayout::bayerRG, 12});
  }
  std::vector<venue::DeviceFault> faultsNow() const {
    std::lock_guard guard(lock_);
    if (bumped_ == 0.0) return {};
    venue::DeviceFault bump;
    bump.kind = venue::FaultKind::shiftedCamera;
    bump.amount = bumped_;
    return {bump};
  }
  void remember(const image::Image& shone) {
    const auto* bytes = reinterpret_cast<const char*>(shone.data().data());
    const std::size_t pattern = std::hash<std::string_view>()({bytes, shone.data().size() * sizeof(float)});
    std::lock_guard guard(lock_);
    patterns_.push_back(pattern);
  }

  /// Called from the camera's thread.
  void look(const test::FakeGigeCamera::View& view) {
    using Clock = std::chrono::steady_clock;
    auto end = Clock::now() +
               std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(view.seconds));
    const Size size = rig_.projectors[0]->size();
    image::Image shone = light_.look(size);
    {
      std::lock_guard guard(lock_);
      end = std::max(end, lastEnd_ + leastInterval_);
      lastEnd_ = end;
    }
    std::this_thread::sleep_until(end);  // what a sensor does
    const image::Image after = light_.look(size);
    for (std::size_t i = 0; i < shone.data().size(); ++i)
      if (after.data()[i] != shone.data()[i]) shone.data()[i] = 0.5f * (shone.data()[i] + after.data()[i]);
    rig::CaptureRequest request;
    {
      std::lock_guard guard(lock_);
      request = request_;
    }
    if (view.format != "BayerRG12" || view.sensor != sensor()) return;
    request.seconds = view.seconds / brightness_;
    rig_.projectors[0]->show(shone);
    test::fillBayerRG12(rig_.cameras[0]->capture(request).signal, view.bytes);
    remember(shone);
    ++photographs_;
  }

  test::ScreenLight light_;
  std::optional<venue::SimulatedVenue> venue_;
  rig::Rig rig_;
  double brightness_ = 1.0;
  mutable std::mutex lock_;
  double bumped_ = 0.0;
  std::chrono::milliseconds leastInterval_{0};
  std::chrono::steady_clock::time_point lastEnd_;
  std::vector<std::size_t> patterns_;
  rig::CaptureRequest request_{{"none", 0}, 0, 1.0};
  std::atomic<int> photographs_ = 0;
  std::unique_ptr<test::FakeGigeCamera> fake_;
};

/// A camera whose seconds are those of the venue.
class VenueTime : public rig::Camera {
 public:
  VenueTime(std::unique_ptr<rig::Camera> camera, Room& room) : camera_(std::move(camera)), room_(room) {}
  std::string name() const override { return camera_->name(); }
  Size size() const override { return camera_->size(); }
  rig::ExposureRange exposures() const override {
    const rig::ExposureRange range = camera_->exposures();
    return {range.shortest / room_.brightness(), std::min(0.2, range.longest) / room_.brightness()};
  }
  rig::RawFrame capture(const rig::CaptureRequest& request) override {
    room_.expect(request);
    rig::CaptureRequest shortened = request;
    shortened.seconds *= room_.brightness();
    rig::RawFrame frame = camera_->capture(shortened);
    frame.seconds /= room_.brightness();
    return frame;
  }

 private:
  std::unique_ptr<rig::Camera> camera_;
  Room& room_;
};

inline void switchScreen(bool on) {
  const Size size = wantedSizes().projector;
  const QString mode = QString("relucent-%1x%2").arg(size.width).arg(size.height);
  if (on)
    xrandr({"--output", "DUMMY1", "--mode", mode, "--right-of", "DUMMY0"});
  else
    xrandr({"--output", "DUMMY1", "--off"});
}

/// A screen of the projector's size right of the projector's.
inline void switchThirdScreen(bool on) {
  const Size size = wantedSizes().projector;
  const QString mode = QString("relucent-%1x%2").arg(size.width).arg(size.height);
  xrandr({"--addmode", "DUMMY2", mode});
  if (on)
    xrandr({"--output", "DUMMY2", "--mode", mode, "--right-of", "DUMMY1"});
  else
    xrandr({"--output", "DUMMY2", "--off"});
  QTRY_VERIFY((screenOn("DUMMY2") != nullptr) == on);
}

}  // namespace relucent::gui
