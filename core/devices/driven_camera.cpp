// SPDX-License-Identifier: MIT
#include "relucent/devices/driven_camera.h"

#include <algorithm>
#include <cmath>

#include "relucent/base/error.h"

namespace relucent::devices {
namespace {

using std::chrono::duration;
using std::chrono::microseconds;

/// Exposure times off by more than this are no longer those of the bracket that was planned.
constexpr double tolerableRatio = 1.5;
/// The ends of a range count as kept to within this.
constexpr double rangeTolerance = 0.05;
/// Exposures longer than this are of no use and would only be waited for.
constexpr double longestUseful = 10.0;

/// A photograph that has to be taken again; the sentence says why.
struct Unusable {
  Message reason;
};

Message thenGoOn(const Message& advice) {
  return RELUCENT_MESSAGE("device.then-go-on", "{}, then go on: every photograph so far is kept")
      .with(advice);
}

microseconds inMicroseconds(double seconds) {
  return std::chrono::duration_cast<microseconds>(duration<double>(seconds));
}

double inSeconds(microseconds time) {
  return duration<double>(time).count();
}

/// A photograph of this size that holds a part from `begin` on.
image::Image placed(const image::Image& part, Pixel begin, Size size) {
  image::Image whole(size, part.channels());
  const auto row = static_cast<std::size_t>(part.width() * part.channels());
  for (int y = 0; y < part.height(); ++y)
    std::copy_n(part.pixel(indexOf(part.size(), {0, y})).data(), row,
                whole.pixel(indexOf(size, {begin.x, begin.y + y})).data());
  return whole;
}

bool near(double a, double b) {
  return std::abs(a - b) <= rangeTolerance * std::max(a, b);
}

}  // namespace

std::vector<Message> problems(const DrivenCameraSettings& settings) {
  std::vector<Message> found;
  if (settings.timeout.count() <= 0)
    found.push_back(RELUCENT_ENGLISH_MESSAGE("device.photograph-timeout-not-positive",
                                             "the time allowed for a photograph must be above 0 seconds"));
  if (settings.attempts < 1)
    found.push_back(RELUCENT_ENGLISH_MESSAGE("device.photograph-attempts-not-positive",
                                             "a photograph needs at least one attempt"));
  if (settings.connectFor.count() < 0 || settings.reconnectFor.count() < 0 ||
      settings.reconnectPause.count() <= 0)
    found.push_back(RELUCENT_ENGLISH_MESSAGE("device.reconnect-times-negative",
                                             "times to look for a lost camera must not be negative"));
  if (settings.skipAfterChange < 0)
    found.push_back(RELUCENT_ENGLISH_MESSAGE("device.skipped-frames-negative",
                                             "the number of frames to skip cannot be negative"));
  return found;
}

DrivenCamera::DrivenCamera(std::unique_ptr<CameraDriver> driver, DrivenCameraSettings settings)
    : driver_(std::move(driver)), settings_(settings) {
  require(problems(settings_).empty(), "{}", fmt::join(problems(settings_), "; "));
  const microseconds begun = driver_->now();
  while (!isConnected_) {
    try {
      traits_ = connected();
    } catch (const CameraLost& lost) {
      driver_->disconnect();
      isConnected_ = false;
      if (driver_->now() - begun >= settings_.connectFor)
        throw Error(ErrorKind::device, lost.reason(),
                    lost.advice().empty() ? RELUCENT_MESSAGE("device.check-cable-power-address",
                                                             "check its cable, its power and its address; "
                                                             "`relucent-cli devices` lists what is there")
                                          : lost.advice(),
                    name());
      driver_->wait(settings_.reconnectPause);
    }
  }
}

DrivenCamera::~DrivenCamera() {
  driver_->disconnect();
}

CameraTraits DrivenCamera::connected() {
  CameraTraits traits = driver_->connect();
  isConnected_ = true;
  lastId_.reset();
  held_ = 0.0;
  asked_ = delivered_ = {{0, 0}, traits.size};
  probe(traits);
  return traits;
}

void DrivenCamera::probe(CameraTraits& traits) {
  const rig::ExposureRange claimed = traits.exposures;
  if (!(claimed.shortest > 0.0) || !(claimed.longest >= claimed.shortest))
    throw Error(
        ErrorKind::device,
        RELUCENT_MESSAGE("device.claimed-exposures-invalid", "the camera claims exposures of {} to {} s")
            .with(as::seconds(claimed.shortest, as::digits(4)), as::seconds(claimed.longest, as::digits(4))),
        RELUCENT_MESSAGE("device.set-manual-exposure-mode",
                         "set its exposure mode to timed and manual, or update its firmware"),
        name());
  const double wanted = std::min(claimed.longest, std::max(longestUseful, claimed.shortest));
  const double longest = driver_->setExposure(wanted);
  const double shortest = driver_->setExposure(claimed.shortest);
  traits.exposures = {std::min(shortest, longest), std::max(shortest, longest)};
  if (!(traits.exposures.shortest > 0.0) || near(shortest, longest))
    throw Error(ErrorKind::device,
                RELUCENT_MESSAGE("device.exposure-time-fixed",
                                 "the camera exposes {} s whatever exposure it is asked for")
                    .with(as::seconds(longest, as::digits(4))),
                RELUCENT_MESSAGE(
                    "device.switch-off-automatic-exposure",
                    "switch its automatic exposure off; a camera without manual exposure cannot be used"),
                name());
  if (!near(longest, wanted))
    traits.remarks.push_back(
        RELUCENT_MESSAGE("device.longest-exposure-overstated",
                         "claims exposures up to {} s but reaches only {} s")
            .with(as::seconds(wanted, as::digits(4)), as::seconds(longest, as::digits(4))));
  if (!near(shortest, claimed.shortest))
    traits.remarks.push_back(
        RELUCENT_MESSAGE("device.shortest-exposure-understated",
                         "claims exposures from {} s but does not go below {} s")
            .with(as::seconds(claimed.shortest, as::digits(4)), as::seconds(shortest, as::digits(4))));
}

void DrivenCamera::reconnect() {
  const microseconds begun = driver_->now();
  for (;;) {
    Message reason, advice;
    try {
      const CameraTraits traits = connected();
      if (traits.size != traits_.size)
        throw Error(ErrorKind::device,
                    RELUCENT_MESSAGE("device.reconnected-camera-size-differs",
                                     "the camera came back with {} pixels instead of {}")
                        .with(as::size(traits.size), as::size(traits_.size)),
                    RELUCENT_MESSAGE("device.reconnect-same-camera",
                                     "connect the camera that the measurement was begun with"),
                    name());
      ++reconnections_;
      return;
    } catch (const CameraLost& lost) {
      reason = lost.reason();
      advice = lost.advice();
    }
    driver_->disconnect();
    isConnected_ = false;
    const microseconds away = driver_->now() - begun;
    if (away >= settings_.reconnectFor)
      throw Error(ErrorKind::device,
                  RELUCENT_MESSAGE("device.camera-not-back", "the camera has been gone for {} s: {}")
                      .with(as::seconds(inSeconds(away), as::decimals(0)), reason),
                  thenGoOn(advice.empty() ? RELUCENT_MESSAGE("device.check-cable-and-power",
                                                             "check its cable and its power")
                                          : advice),
                  name());
    driver_->wait(settings_.reconnectPause);
  }
}

double DrivenCamera::expose(double seconds) {
  const double held = driver_->setExposure(seconds);
  if (!(held > 0.0) || held > tolerableRatio * seconds || seconds > tolerableRatio * held)
    throw Error(
        ErrorKind::device,
        RELUCENT_MESSAGE("device.exposure-refused", "the camera was asked to expose {} s but exposes {} s")
            .with(as::seconds(seconds, as::digits(4)), as::seconds(held, as::digits(4))),
        RELUCENT_MESSAGE("device.lift-exposure-limits",
                         "switch its automatic exposure and its frame rate limit off"),
        name());
  if (held != held_) toSkip_ = settings_.skipAfterChange;
  held_ = held;
  return held;
}

void DrivenCamera::look(const std::optional<rig::PicturePart>& part) {
  // To change it takes as long as some photographs.
  constexpr double worthIt = 0.9;
  rig::PicturePart wanted = part.value_or(all());
  if (static_cast<double>(wanted.size.count()) > worthIt * static_cast<double>(traits_.size.count()))
    wanted = all();
  if (wanted == asked_) return;
  delivered_ = driver_->look(wanted).value_or(all());
  asked_ = wanted;
  lastId_.reset();
}

bool DrivenCamera::isStale(const DriverFrame& frame, microseconds asked, double seconds) const {
  const microseconds begun =
      settings_.exposureTakesTime ? frame.arrived - inMicroseconds(seconds) : frame.arrived;
  return begun < asked || (lastId_ && *lastId_ == frame.id);
}

DriverFrame DrivenCamera::freshFrame(double seconds) {
  const microseconds allowed = settings_.timeout + inMicroseconds(seconds);
  microseconds asked = driver_->now();
  driver_->trigger();
  // A camera that runs by itself may have a frame under way and has to finish that first.
  microseconds deadline = asked + allowed + (traits_.triggered ? microseconds{0} : inMicroseconds(seconds));
  for (;;) {
    std::optional<DriverFrame> frame = driver_->next(std::max(microseconds{0}, deadline - driver_->now()));
    if (!frame)
      throw Unusable{RELUCENT_MESSAGE("device.photograph-timed-out", "no photograph came within {} s")
                         .with(as::seconds(inSeconds(deadline - asked), as::digits(3)))};
    if (isStale(*frame, asked, seconds)) continue;
    if (toSkip_ > 0) {
      --toSkip_;
      asked = driver_->now();
      deadline += allowed;
      driver_->trigger();
      continue;
    }
    if (!frame->damage.empty()) throw Unusable{frame->damage};
    lastId_ = frame->id;
    return *std::move(frame);
  }
}

bool DrivenCamera::restarted() {
  try {
    driver_->restart();
    return true;
  } catch (const CameraLost&) {
    return false;
  }
}

rig::RawFrame DrivenCamera::capture(const rig::CaptureRequest& request) {
  Message reason, advice;
  for (int attempt = 0; attempt < settings_.attempts; ++attempt) {
    if (attempt > 0) ++repeats_;
    try {
      if (!isConnected_) reconnect();
      look(request.part);
      const double seconds = expose(request.seconds);
      const DriverFrame taken = freshFrame(seconds);
      const Size size = photographSize(taken.frame.size, taken.frame.format);
      if (size != delivered_.size || taken.frame.format != traits_.format)
        throw CameraLost(RELUCENT_MESSAGE("device.photograph-format-changed",
                                          "the photograph has {} pixels as {} where {} as {} were agreed")
                             .with(as::size(size), nameOf(taken.frame.format), as::size(delivered_.size),
                                   nameOf(traits_.format)));
      image::Image photograph = photographOf(taken.frame, name());
      if (size != traits_.size) photograph = placed(photograph, delivered_.begin, traits_.size);
      return {std::move(photograph), photographBits(taken.frame), seconds};
    } catch (const Unusable& unusable) {
      reason = unusable.reason;
      advice = {};
      // Once may be chance. Twice, and the camera may have forgotten how it was set up.
      isConnected_ = attempt == 0 && restarted();
    } catch (const CameraLost& lost) {
      reason = lost.reason();
      advice = lost.advice();
      isConnected_ = false;
    }
    if (!isConnected_) driver_->disconnect();
  }
  throw Error(
      ErrorKind::device,
      RELUCENT_MESSAGE("device.photograph-attempts-failed", "{} attempts at a photograph failed: {}")
          .with(settings_.attempts, reason),
      thenGoOn(advice.empty()
                   ? RELUCENT_MESSAGE(
                         "device.check-cable-network-and-programs",
                         "check the camera's cable and network card, and that no other program uses it")
                   : advice),
      name());
}

}  // namespace relucent::devices
