// SPDX-License-Identifier: MIT
#pragma once

#include <deque>

#include "core/devices/scripted_gphoto.h"
#include "disturbed_venue.h"
#include "relucent/base/error.h"
#include "relucent/devices/driven_camera.h"
#include "relucent/devices/screen_rig.h"
#include "relucent/venue/venue.h"

/// A simulated venue behind the seams of real devices: a camera's library, a still camera's port, a screen.
/// Faults strike there when they are told to, so that all above the seams is what runs at a real venue.
/// Clocks move only when they are waited for.
namespace relucent::test {

/// A triggered camera of a network, with frames numbered again at each connection.
class DisturbedDriver : public devices::CameraDriver {
 public:
  explicit DisturbedDriver(std::shared_ptr<DisturbedVenue> venue) : venue_(std::move(venue)) {}

  std::string name() const override { return "scripted"; }
  devices::CameraTraits connect() override {
    answer();
    disconnect();
    frames_ = 0;
    return {"Simulated",
            venue_->size(),
            {devices::SensorLayout::rgb, 12},
            venue_->disturbance().claimed,
            true,
            0.0,
            {}};
  }
  void disconnect() noexcept override { underWay_.clear(); }
  double setExposure(double seconds) override {
    answer();
    exposure_ = venue_->kept(seconds);
    told_ = venue_->disturbance().fault == Fault::cutUnseen ? seconds : exposure_;
    return told_;
  }
  void trigger() override {
    answer();
    devices::DriverFrame good{venue_->photograph(exposure_), frames_ + 1,
                              clock_ + inMicroseconds(told_ + 0.02)};
    // Taken again it is the same to the bit, and no older one.
    if (last_.frame.bytes != good.frame.bytes) before_ = last_;
    last_ = good;
    ++frames_;
    underWay_.push_back(good);
    if (venue_->strikes(Fault::lostPackets)) {
      devices::DriverFrame& frame = underWay_.back();
      std::fill(frame.frame.bytes.begin() + std::ssize(frame.frame.bytes) / 3, frame.frame.bytes.end(), 0);
      frame.damage = Message::plain("parts of the photograph were lost");
    } else if (venue_->strikes(Fault::noFrame)) {
      underWay_.clear();
    } else if (venue_->strikes(Fault::otherSize)) {
      --underWay_.back().frame.size.height;
    } else if (venue_->strikes(Fault::staleFirst)) {
      arriveFirst(clock_ + moment, good.id);
      underWay_.back().id = last_.id = ++frames_;
    } else if (venue_->strikes(Fault::staleOnly)) {
      arriveFirst(clock_ + moment, good.id);
      underWay_.pop_back();
    } else if (venue_->strikes(Fault::sameNumber)) {
      arriveFirst(good.arrived - moment, before_.id);
    } else if (venue_->strikes(Fault::unplugged)) {
      goneUntil_ = clock_ + venue_->disturbance().lasts;
    }
  }
  std::optional<devices::DriverFrame> next(std::chrono::microseconds limit) override {
    answer();
    if (underWay_.empty() || underWay_.front().arrived > clock_ + limit) {
      clock_ += limit;
      return std::nullopt;
    }
    devices::DriverFrame frame = std::move(underWay_.front());
    underWay_.pop_front();
    clock_ = std::max(clock_, frame.arrived);
    ++venue_->delivered;
    return frame;
  }
  void restart() override { underWay_.clear(); }
  std::chrono::microseconds now() const override { return clock_; }
  void wait(std::chrono::microseconds limit) override { clock_ += limit; }

 private:
  static constexpr std::chrono::milliseconds moment{1};
  static std::chrono::microseconds inMicroseconds(double seconds) {
    return std::chrono::round<std::chrono::microseconds>(std::chrono::duration<double>(seconds));
  }
  void answer() const {
    if (clock_ < goneUntil_) throw devices::CameraLost(Message::plain("the cable was pulled"));
  }
  /// The photograph before, once more.
  void arriveFirst(std::chrono::microseconds arrived, std::uint64_t id) {
    require(!before_.frame.bytes.empty(), "there is no photograph before");
    devices::DriverFrame frame = before_;
    frame.arrived = arrived;
    frame.id = id;
    underWay_.push_front(std::move(frame));
  }

  std::shared_ptr<DisturbedVenue> venue_;
  std::chrono::microseconds clock_{10'000'000}, goneUntil_{};
  double exposure_ = 0.0, told_ = 0.0;
  std::uint64_t frames_ = 0;
  devices::DriverFrame last_, before_;  // before_: the newest that shows something else than the last
  std::deque<devices::DriverFrame> underWay_;
};

/// A still camera whose files hold what it sees of the venue.
class DisturbedPort : public ScriptedPort {
 public:
  DisturbedPort(std::shared_ptr<StillScript> script, std::shared_ptr<DisturbedVenue> venue)
      : ScriptedPort(script), script_(std::move(script)), venue_(std::move(venue)) {
    script_->file = [this](double seconds) { return venue_->photograph(seconds).bytes; };
  }
  void trigger() override {
    if (venue_->isWithin20Shots(Fault::flatBattery)) script_->settings["batterylevel"].value = "8%";
    if (venue_->strikes(Fault::fullCard))
      script_->be(StillScript::Trouble::full, venue_->disturbance().lasts);
    if (venue_->strikes(Fault::lateFile)) script_->answers.push_back(StillScript::Answer::late);
    ScriptedPort::trigger();
    if (venue_->strikes(Fault::flatBattery))
      script_->be(StillScript::Trouble::flat, venue_->disturbance().lasts);
  }

 private:
  std::shared_ptr<StillScript> script_;
  std::shared_ptr<DisturbedVenue> venue_;
};

class DisturbedScreen : public devices::ScreenProjector {
 public:
  explicit DisturbedScreen(std::shared_ptr<DisturbedVenue> venue) : venue_(std::move(venue)) {}
  std::string name() const override { return "HDMI-1"; }
  Size size() const override { return venue_->projector().size(); }
  int bits() const override { return venue_->projector().bits(); }
  void show(const image::Image& picture) override { venue_->show(picture); }
  bool stayedVisible() override { return venue_->stayedVisible(); }
  void rest() override {}

 private:
  std::shared_ptr<DisturbedVenue> venue_;
};

enum class CameraKind { network, still };

/// The devices of one run, and what they say of it afterwards.
class DisturbedRig {
 public:
  DisturbedRig(const venue::SimulatedVenue& simulated, CameraKind kind, const Disturbance& disturbance)
      : venue_(std::make_shared<DisturbedVenue>(simulated.rig(), disturbance)) {
    auto camera = kind == CameraKind::still ? stillCamera() : networkCamera();
    camera_ = camera.get();
    screen_ = screenRig(std::make_unique<DisturbedScreen>(venue_),
                        std::make_unique<NamingCamera>(std::move(camera), venue_), {0.0, shortExposure},
                        [](double) {});
  }

  rig::Rig& rig() { return screen_.rig; }
  const devices::DrivenCamera& camera() const { return *camera_; }
  const DisturbedVenue& venue() const { return *venue_; }
  /// Frames that came and were not used.
  int dropped() const { return venue_->delivered - venue_->captures; }

 private:
  class NamingCamera : public rig::Camera {
   public:
    NamingCamera(std::unique_ptr<rig::Camera> camera, std::shared_ptr<DisturbedVenue> venue)
        : camera_(std::move(camera)), venue_(std::move(venue)) {}
    std::string name() const override { return camera_->name(); }
    Size size() const override { return camera_->size(); }
    rig::ExposureRange exposures() const override { return camera_->exposures(); }
    rig::RawFrame capture(const rig::CaptureRequest& request) override {
      venue_->ask(request);
      rig::RawFrame frame = camera_->capture(request);
      ++venue_->captures;
      return frame;
    }

   private:
    std::unique_ptr<rig::Camera> camera_;
    std::shared_ptr<DisturbedVenue> venue_;
  };

  std::unique_ptr<devices::DrivenCamera> networkCamera() {
    return std::make_unique<devices::DrivenCamera>(std::make_unique<DisturbedDriver>(venue_));
  }
  std::unique_ptr<devices::DrivenCamera> stillCamera() {
    auto script = std::make_shared<StillScript>(canon());
    script->settings["shutterspeed"].choices = {"1", "1/8", "1/80", "1/1000"};
    auto read = [size = venue_->size()](const std::vector<std::uint8_t>& bytes, const std::string&) {
      devices::RawPhotograph photograph;
      photograph.frame = {size, {devices::SensorLayout::rgb, 12}, bytes};
      return photograph;
    };
    return std::make_unique<devices::DrivenCamera>(
        devices::makeGphotoDriver(std::make_unique<DisturbedPort>(script, venue_), {"Canon EOS 80D", {}, {}},
                                  read),
        devices::gphotoPatience());
  }

  std::shared_ptr<DisturbedVenue> venue_;
  devices::DrivenCamera* camera_ = nullptr;
  devices::ScreenRig screen_;
};

}  // namespace relucent::test
