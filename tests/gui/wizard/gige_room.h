// SPDX-License-Identifier: MIT
#pragma once

#include <QtTest>
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
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
#include "relucent/reduction/reduced_rig.h"
#include "relucent/venue/device_faults.h"
#include "relucent/venue/venue.h"
#include "support/fake_gige_camera.h"
#include "support/own_network.h"
#include "support/screen_light.h"

/// A simulated venue behind real devices: the projectors are windows on screens of an X server beside the
/// operator's, whose pixels are read from those screens; the cameras are GigE Vision ones on a loopback
/// network. $RELUCENT_REAL_SIZES "256x192 160x120" makes it as large as wanted.
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

/// A camera of the room.
struct RoomCamera {
  std::string serial = "RL01";
  /// The sensor, where that is another than the venue's camera has; see reduction::reductionTo().
  std::optional<reduction::Reduction> sensor{};
  double gamma = 1.0;  // signal = light^(1 / gamma)
};

/// What stands in it: screens that are a venue's projectors, and cameras in the places of its own.
struct RoomDevices {
  std::vector<std::string> screens{"DUMMY1"};
  std::vector<RoomCamera> cameras{RoomCamera{}};
  double framesPerSecond = frameRate;  // of the screens: eight of them expose full light well
};

/// A venue's light where the screens shine, photographed by cameras on the network. A projector or camera of
/// the venue for which nothing stands here is dark or does not look.
class Room {
 public:
  Room(const venue::VenueSettings& settings, const std::filesystem::path& cache, RoomDevices devices = {})
      : devices_(std::move(devices)), settings_(settings), cache_(cache) {
    furnish(settings, cache);
    for (const auto& projector : rig_.projectors) projectorSizes_.push_back(projector->size());
    for (const auto& camera : seen_.cameras) cameraSizes_.push_back(camera->size());
    for (const std::string& screen : devices_.screens)
      screens_.push_back(std::make_unique<test::ScreenLight>(screen));
    requests_.resize(rig_.cameras.size(), {{"none", 0}, 0, 1.0});
    brightness_ = 8.0 / devices_.framesPerSecond / wellExposed();
    for (std::size_t i = 0; i < devices_.cameras.size(); ++i) {
      test::FakeGigeSettings camera;
      camera.serial = devices_.cameras[i].serial;
      camera.address = test::ownAddress(static_cast<int>(i));
      camera.sensor = devices::sensorSize(size(i), format);
      fakes_.push_back(std::make_unique<test::FakeGigeCamera>(
          camera, [this, i](const test::FakeGigeCamera::View& view) { look(i, view); }));
    }
  }
  ~Room() { fakes_.clear(); }

  bool isRunning() const {
    return std::ranges::all_of(fakes_, [](const auto& fake) { return fake->isRunning(); });
  }
  std::size_t cameras() const { return fakes_.size(); }
  test::FakeGigeCamera& camera(std::size_t index = 0) { return *fakes_[index]; }
  /// Of a camera's photographs.
  Size size(std::size_t camera = 0) const { return cameraSizes_[camera]; }
  /// By all cameras.
  int photographs() const { return photographs_; }
  /// Seconds of the cameras' that are one of the venue's: its exposures need not be waited for in full.
  double brightness() const { return brightness_; }
  /// What happens in the room from now on, besides what became of it: until another one of its kind comes, or
  /// for an amount of 0 no longer.
  void happen(const venue::DeviceFault& fault) {
    std::lock_guard guard(lock_);
    std::erase_if(faults_, [&](const venue::DeviceFault& each) { return each.kind == fault.kind; });
    if (fault.amount != 0.0) faults_.push_back(fault);
  }
  /// Somebody bumps the first camera: what it sees has moved by so many pixels to the right and down. 0: it
  /// is put back.
  void bump(double pixels) {
    venue::DeviceFault bump;
    bump.kind = venue::FaultKind::shiftedCamera;
    bump.amount = pixels;
    happen(bump);
  }
  /// What has become of it since it was built. Its light is traced, which takes a while.
  void change(const venue::Changes& changes) {
    settings_.changes = changes;
    furnish(settings_, cache_);
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
  /// Which photograph of a camera's comes next: what noise depends on.
  void expect(const rig::CaptureRequest& request, std::size_t camera = 0) {
    std::lock_guard guard(lock_);
    requests_[camera] = request;
  }
  /// A photograph of what the screens show now, exposed so long from now on. From any thread.
  image::Image photograph(std::size_t camera, double seconds) {
    using Clock = std::chrono::steady_clock;
    auto end =
        Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
    std::vector<image::Image> shone = shining();
    {
      std::lock_guard guard(lock_);
      end = std::max(end, lastEnd_ + leastInterval_);
      lastEnd_ = end;
    }
    std::this_thread::sleep_until(end);  // what a sensor does
    const std::vector<image::Image> after = shining();
    for (std::size_t p = 0; p < shone.size(); ++p)
      for (std::size_t i = 0; i < shone[p].data().size(); ++i)
        if (after[p].data()[i] != shone[p].data()[i])
          shone[p].data()[i] = 0.5f * (shone[p].data()[i] + after[p].data()[i]);
    rig::CaptureRequest request;
    {
      std::lock_guard guard(lock_);
      request = requests_[camera];
    }
    request.seconds = seconds / brightness_;
    image::Image signal = lit(shone, camera, request);
    if (camera < devices_.cameras.size() && devices_.cameras[camera].gamma != 1.0)
      for (float& value : signal.data())
        value = std::pow(std::max(value, 0.0f), static_cast<float>(1.0 / devices_.cameras[camera].gamma));
    remember(shone);
    ++photographs_;
    return signal;
  }

 private:
  static constexpr devices::SensorFormat format{devices::SensorLayout::bayerRG, 12};

  double wellExposed() {
    for (const auto& projector : rig_.projectors) projector->show(image::Image(projector->size(), 3, 1.0f));
    double seconds = 1e-4;
    while (seconds < 10.0 && devices::meanSignal(seen_.cameras[0]->capture({{"try", 0}, 0, seconds})) < 0.3)
      seconds *= 1.3;
    return seconds;
  }

  void furnish(const venue::VenueSettings& settings, const std::filesystem::path& cache) {
    Progress silent;
    auto venue = std::make_unique<venue::SimulatedVenue>(settings, cache, silent);
    rig::Rig rig = venue->rig([this](const rig::ShotId&) {
      std::lock_guard guard(lock_);
      return faults_;
    });
    std::vector<reduction::Reduction> sensors;
    for (std::size_t i = 0; i < rig.cameras.size(); ++i) {
      const bool isOwn = i < devices_.cameras.size() && devices_.cameras[i].sensor;
      sensors.push_back(isOwn ? *devices_.cameras[i].sensor : reduction::noReduction(rig.cameras[i]->size()));
    }
    rig::Rig seen = reduction::reduced(rig, sensors);
    std::lock_guard guard(light_);
    seen_ = std::move(seen);
    rig_ = std::move(rig);
    venue_ = std::move(venue);
  }
  void remember(const std::vector<image::Image>& shone) {
    std::size_t pattern = 0;
    for (const image::Image& one : shone) {
      const auto* bytes = reinterpret_cast<const char*>(one.data().data());
      pattern = 31 * pattern + std::hash<std::string_view>()({bytes, one.data().size() * sizeof(float)});
    }
    std::lock_guard guard(lock_);
    patterns_.push_back(pattern);
  }

  /// On each projector's screen.
  std::vector<image::Image> shining() const {
    std::vector<image::Image> all;
    for (std::size_t i = 0; i < projectorSizes_.size(); ++i)
      all.push_back(i < screens_.size() ? screens_[i]->look(projectorSizes_[i])
                                        : image::Image(projectorSizes_[i], 3));
    return all;
  }
  image::Image lit(const std::vector<image::Image>& shone, std::size_t camera,
                   const rig::CaptureRequest& request) {
    std::lock_guard guard(light_);
    for (std::size_t i = 0; i < shone.size(); ++i) rig_.projectors[i]->show(shone[i]);
    return seen_.cameras[camera]->capture(request).signal;
  }

  /// Called from the camera's thread.
  void look(std::size_t camera, const test::FakeGigeCamera::View& view) {
    const Size sensor = devices::sensorSize(size(camera), format);
    if (view.format != devices::nameOf(format) || view.begin.x + view.sensor.width > sensor.width ||
        view.begin.y + view.sensor.height > sensor.height)
      return;
    const int cell = devices::sensorSize({1, 1}, format).width;
    const reduction::Reducer part(reduction::reductionTo(size(camera),
                                                         {view.begin.x / cell, view.begin.y / cell},
                                                         devices::photographSize(view.sensor, format), 1));
    const rig::RawFrame whole{photograph(camera, view.seconds), 0, view.seconds};
    test::fillBayerRG12(part(whole).signal, view.bytes);
  }

  RoomDevices devices_;
  std::vector<std::unique_ptr<test::ScreenLight>> screens_;
  venue::VenueSettings settings_;
  std::filesystem::path cache_;
  std::unique_ptr<venue::SimulatedVenue> venue_;
  std::vector<Size> projectorSizes_, cameraSizes_;
  rig::Rig rig_, seen_;  // the venue's devices, and the same through the room's sensors
  double brightness_ = 1.0;
  std::mutex light_;  // one camera looks at a time
  mutable std::mutex lock_;
  std::vector<venue::DeviceFault> faults_;
  std::chrono::milliseconds leastInterval_{0};
  std::chrono::steady_clock::time_point lastEnd_;
  std::vector<std::size_t> patterns_;
  std::vector<rig::CaptureRequest> requests_;
  std::atomic<int> photographs_ = 0;
  std::vector<std::unique_ptr<test::FakeGigeCamera>> fakes_;
};

/// A camera whose seconds are those of the venue.
class VenueTime : public rig::Camera {
 public:
  VenueTime(std::unique_ptr<rig::Camera> camera, Room& room, std::size_t index = 0)
      : camera_(std::move(camera)), room_(room), index_(index) {}
  std::string name() const override { return camera_->name(); }
  Size size() const override { return camera_->size(); }
  rig::ExposureRange exposures() const override {
    const rig::ExposureRange range = camera_->exposures();
    return {range.shortest / room_.brightness(), std::min(0.2, range.longest) / room_.brightness()};
  }
  rig::RawFrame capture(const rig::CaptureRequest& request) override {
    room_.expect(request, index_);
    rig::CaptureRequest shortened = request;
    shortened.seconds *= room_.brightness();
    rig::RawFrame frame = camera_->capture(shortened);
    frame.seconds /= room_.brightness();
    return frame;
  }

 private:
  std::unique_ptr<rig::Camera> camera_;
  Room& room_;
  std::size_t index_;
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
