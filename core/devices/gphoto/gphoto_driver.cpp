// SPDX-License-Identifier: MIT
#include "relucent/devices/gphoto/gphoto_driver.h"

#include <algorithm>

#include "relucent/base/error.h"
#include "relucent/devices/gphoto/gphoto_failure.h"
#include "relucent/devices/gphoto/gphoto_setup.h"

namespace relucent::devices {
namespace {

using namespace std::chrono_literals;
using std::chrono::microseconds;

/// Of the photograph that tells the size: neither slow nor at the end of any list.
constexpr double trialSeconds = 1.0 / 60.0;
constexpr microseconds trialTime = 20s;
/// A photograph that did not come in time may still be written for so long.
constexpr microseconds latestTime = 20s;
/// Between two looks whether anything else is left to be heard.
constexpr microseconds eventTimeout = 1ms;
/// Words that a camera may have left from before; a camera that never falls silent is left talking.
constexpr int mostPendingEvents = 200;

/// The part of `size` around the middle. An even corner keeps the colour filter's order.
SensorFrame cut(const SensorFrame& frame, Size size) {
  const std::size_t each = frame.format.bits > 8 ? 2 : 1;
  const auto left = static_cast<std::size_t>((frame.size.width - size.width) / 4 * 2);
  const auto top = static_cast<std::size_t>((frame.size.height - size.height) / 4 * 2);
  SensorFrame part{size, frame.format, {}, frame.levels};
  for (std::size_t y = top; y < top + static_cast<std::size_t>(size.height); ++y) {
    const auto row =
        frame.bytes.begin() +
        static_cast<std::ptrdiff_t>(each * (y * static_cast<std::size_t>(frame.size.width) + left));
    part.bytes.insert(part.bytes.end(), row,
                      row + static_cast<std::ptrdiff_t>(each * static_cast<std::size_t>(size.width)));
  }
  return part;
}

class GphotoDriver : public CameraDriver {
  /// Does `action`; what fails becomes a sentence.
  template <typename Action>
  auto guarded(const Action& action) {
    try {
      return action();
    } catch (const GphotoFailure& failure) {
      throw lostBy(failure, {isListed(), battery_});
    }
  }

 public:
  GphotoDriver(std::unique_ptr<GphotoPort> port, GphotoCameraSettings settings, RawReader read)
      : port_(std::move(port)), settings_(std::move(settings)), read_(std::move(read)), borrowed_(*port_) {}
  ~GphotoDriver() override { GphotoDriver::disconnect(); }

  std::string name() const override { return "gphoto2:" + settings_.camera; }

  CameraTraits connect() override {
    disconnect();
    return guarded([&] {
      const GphotoCamera camera = find();
      seen_ = camera.model;
      port_->open(camera);
      isOpen_ = true;
      isOwed_ = false;
      if (camera.model != model_) borrowed_.forget();
      model_ = camera.model;
      CameraTraits traits;
      traits.model = camera.model;
      traits.triggered = true;
      setup_ = setUpGphoto(borrowed_, name(), settings_.iso, traits);
      askForBattery();
      learnFrames(traits);
      return traits;
    });
  }

  void disconnect() noexcept override {
    if (!isOpen_) return;
    borrowed_.restore();
    port_->close();
    isOpen_ = false;
  }

  double setExposure(double seconds) override {
    return guarded([&] {
      bulbSeconds_.reset();
      if (setup_.bulb && setup_.speeds.needsBulb(seconds)) {
        if (!borrowed_.set(setup_.shutter, *setup_.speeds.bulb()))
          throw GphotoFailure(GphotoFault::refused, "its shutter cannot be set to bulb");
        bulbSeconds_ = seconds;
        return seconds;
      }
      borrowed_.set(setup_.shutter, setup_.speeds.nearest(seconds).word);
      const std::optional<GphotoSetting> held = borrowed_.get(setup_.shutter);
      return held ? secondsFromShutter(held->value).value_or(0.0) : 0.0;
    });
  }

  void trigger() override {
    guarded([&] {
      discardPendingEvents();
      isOwed_ = true;
      if (bulbSeconds_)
        exposeBulb(*bulbSeconds_);
      else
        retryWhileBusy(*port_, [&] { port_->trigger(); });
    });
  }

  std::optional<DriverFrame> next(microseconds time) override {
    return guarded([&]() -> std::optional<DriverFrame> {
      const microseconds deadline = port_->now() + time;
      std::string developed;
      do {
        const GphotoPort::Event event =
            port_->waitEvent(std::clamp(deadline - port_->now(), eventTimeout, microseconds(1s)));
        if (!event.file) continue;
        const microseconds arrived = port_->now();
        if (isRawName(event.file->name)) {
          isOwed_ = false;
          return frameOf(*event.file, arrived);
        }
        developed = event.file->name;  // its raw file may come next
        discard(*event.file);
      } while (port_->now() < deadline);
      explainSilence();
      if (developed.empty()) return std::nullopt;
      return damaged(
          RELUCENT_MESSAGE("device.no-raw-file-sent", "the camera sent {} and no raw file").with(developed),
          port_->now());
    });
  }

  /// Files have no numbers that would tell a late one from the next: it has to come first, or the camera to
  /// be connected again.
  void restart() override {
    guarded([&] {
      const microseconds deadline = port_->now() + latestTime;
      while (isOwed_ && port_->now() < deadline) {
        const GphotoPort::Event event =
            port_->waitEvent(std::clamp(deadline - port_->now(), eventTimeout, microseconds(1s)));
        if (!event.file) continue;
        isOwed_ = !isRawName(event.file->name);
        discard(*event.file);
      }
      if (isOwed_)
        throw CameraLost(
            RELUCENT_MESSAGE("device.no-photograph-came", "a photograph was asked for and none came"));
      discardPendingEvents();
    });
  }

  microseconds now() const override { return port_->now(); }
  void wait(microseconds time) override { port_->wait(time); }

 private:
  GphotoCamera find() const {
    const std::vector<GphotoCamera> cameras = port_->list();
    std::vector<GphotoCamera> meant;
    for (const GphotoCamera& camera : cameras)
      if (camera.port == settings_.camera || isSameModel(camera.model, settings_.camera))
        meant.push_back(camera);
    if (meant.size() > 1)
      throw Error(
          ErrorKind::device,
          RELUCENT_MESSAGE("device.several-cameras-of-model", "{} cameras of this model are plugged in")
              .with(meant.size()),
          RELUCENT_MESSAGE("device.name-camera-by-port", "name one by its port: gphoto2:{} or gphoto2:{}")
              .with(meant[0].port, meant[1].port),
          name());
    if (meant.size() == 1) return meant.front();
    if (cameras.empty() || !model_.empty()) throw GphotoFailure(GphotoFault::absent, "not listed");
    throw CameraLost(RELUCENT_MESSAGE("device.only-other-camera-connected",
                                      "no camera of this name is plugged in, but {} is")
                         .with(cameras.front().model),
                     RELUCENT_MESSAGE("device.name-connected-camera", "name that one: gphoto2:{}")
                         .with(cameras.front().model));
  }

  bool isListed() const {
    const std::vector<GphotoCamera> cameras = port_->list();
    return std::any_of(cameras.begin(), cameras.end(),
                       [&](const GphotoCamera& camera) { return camera.model == seen_; });
  }

  void askForBattery() {
    if (const auto level = borrowed_.get("batterylevel"))
      if (const std::optional<int> percent = batteryPercent(level->value)) battery_ = percent;
  }

  /// Size and format of frames, from one that is taken.
  void learnFrames(CameraTraits& traits) {
    setExposure(std::clamp(trialSeconds, traits.exposures.shortest, traits.exposures.longest));
    trigger();
    const std::optional<DriverFrame> trial = next(trialTime);
    if (!trial)
      throw CameraLost(RELUCENT_MESSAGE("device.trial-photograph-failed",
                                        "the camera was asked for a photograph and took none"),
                       RELUCENT_MESSAGE("device.take-photograph-by-hand",
                                        "switch its lens to manual focus, close its menus, and take a "
                                        "photograph by hand to see what it complains of"));
    if (!trial->damage.empty()) throw CameraLost(trial->damage);
    traits.size = photographSize(trial->frame.size, trial->frame.format);
    traits.format = trial->frame.format;
    if (traits.format.layout == SensorLayout::mono)
      traits.remarks.push_back(RELUCENT_MESSAGE(
          "device.sees-no-colours", "sees no colours: brightness can be compensated, colours cannot"));
  }

  /// Hears and forgets what the camera still has to say, photographs that were taken by hand included: they
  /// stay in the camera.
  void discardPendingEvents() {
    for (int events = 0; events < mostPendingEvents; ++events)
      if (port_->waitEvent(eventTimeout).timedOut) return;
  }

  void exposeBulb(double seconds) {
    const GphotoSetup::Bulb& bulb = *setup_.bulb;
    retryWhileBusy(*port_, [&] { port_->set(bulb.setting, bulb.open); });
    port_->wait(std::chrono::duration_cast<microseconds>(std::chrono::duration<double>(seconds)));
    retryWhileBusy(*port_, [&] { port_->set(bulb.setting, bulb.close); });
  }

  DriverFrame damaged(Message reason, microseconds arrived) {
    DriverFrame frame;
    frame.id = ++count_;
    frame.arrived = arrived;
    frame.damage = std::move(reason);
    return frame;
  }

  DriverFrame frameOf(const GphotoFile& file, microseconds arrived) {
    const std::vector<std::uint8_t> bytes = retryWhileBusy(*port_, [&] { return port_->download(file); });
    discard(file);
    if (count_ % 16 == 0) askForBattery();
    try {
      RawPhotograph photograph = read_(bytes, file.name);
      DriverFrame frame;
      frame.id = ++count_;
      frame.arrived = arrived;
      frame.frame = std::move(photograph.frame);
      if (settings_.photograph) cropToSettings(frame.frame);
      return frame;
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::format) throw;
      return damaged(RELUCENT_MESSAGE("sentence.explained", "{} ({})").with(error.summary(), error.advice()),
                     arrived);
    }
  }

  void cropToSettings(SensorFrame& frame) const {
    const Size wanted = *settings_.photograph, has = photographSize(frame.size, frame.format);
    if (wanted.width > has.width || wanted.height > has.height)
      throw Error(
          ErrorKind::device,
          RELUCENT_MESSAGE("device.photograph-exceeds-sensor", "{} pixels are wanted and the camera has {}")
              .with(as::size(wanted), as::size(has)),
          RELUCENT_MESSAGE("device.ask-for-fewer-pixels", "ask for that or less"), name());
    frame = cut(frame, sensorSize(wanted, frame.format));
  }

  /// Photographs that were asked for do not stay in the camera; its memory would be full after some.
  void discard(const GphotoFile& file) {
    try {
      port_->remove(file);
    } catch (const GphotoFailure&) {
      // Some cameras drop it by themselves; a full card is told when it is.
    }
  }

  /// Why no photograph came, if the camera can say. Throws: CameraLost, GphotoFailure.
  void explainSilence() {
    askForBattery();
    if (battery_ && *battery_ <= emptyBattery) throw lostByEmptyBattery(*battery_);
    if (const auto room = borrowed_.get("availableshots"); room && room->value == "0") throw lostByFullCard();
  }

  std::unique_ptr<GphotoPort> port_;
  GphotoCameraSettings settings_;
  RawReader read_;
  BorrowedSettings borrowed_;
  GphotoSetup setup_;
  std::string seen_;   // model of the camera that was last connected to
  std::string model_;  // whose settings are borrowed
  bool isOpen_ = false;
  bool isOwed_ = false;  // a photograph was asked for and has not come
  std::optional<double> bulbSeconds_;
  std::optional<int> battery_;
  std::uint64_t count_ = 0;
};

}  // namespace

std::unique_ptr<CameraDriver> makeGphotoDriver(std::unique_ptr<GphotoPort> port,
                                               GphotoCameraSettings settings, RawReader read) {
  require(problems(settings).empty(), "{}", fmt::join(problems(settings), "; "));
  return std::make_unique<GphotoDriver>(std::move(port), std::move(settings), std::move(read));
}

}  // namespace relucent::devices
