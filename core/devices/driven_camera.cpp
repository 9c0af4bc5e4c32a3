// SPDX-License-Identifier: MIT
#include "devices/driven_camera.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"

namespace relucent {
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
  std::string reason;
};

microseconds inMicroseconds(double seconds) {
  return std::chrono::duration_cast<microseconds>(duration<double>(seconds));
}

double inSeconds(microseconds time) {
  return duration<double>(time).count();
}

bool near(double a, double b) {
  return std::abs(a - b) <= rangeTolerance * std::max(a, b);
}

}  // namespace

std::vector<std::string> problems(const DrivenCameraSettings& settings) {
  std::vector<std::string> found;
  if (settings.timeout.count() <= 0) found.push_back("a photograph needs time");
  if (settings.attempts < 1) found.push_back("a photograph needs at least one attempt");
  if (settings.connectFor.count() < 0 || settings.reconnectFor.count() < 0 ||
      settings.reconnectPause.count() <= 0)
    found.push_back("times to look for a lost camera must not be negative");
  if (settings.skipAfterChange < 0) found.push_back("no fewer than 0 frames can be skipped");
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
        throw Error(
            ErrorKind::device, lost.what(),
            lost.advice().empty()
                ? "check its cable, its power and its address; `relucent-cli devices` lists what is there"
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
  probe(traits);
  return traits;
}

void DrivenCamera::probe(CameraTraits& traits) {
  const ExposureRange claimed = traits.exposures;
  if (!(claimed.shortest > 0.0) || !(claimed.longest >= claimed.shortest))
    throw Error(
        ErrorKind::device,
        fmt::format("the camera claims exposures of {:.4g} to {:.4g} s", claimed.shortest, claimed.longest),
        "set its exposure mode to timed and manual, or update its firmware", name());
  const double wanted = std::min(claimed.longest, std::max(longestUseful, claimed.shortest));
  const double longest = driver_->setExposure(wanted);
  const double shortest = driver_->setExposure(claimed.shortest);
  traits.exposures = {std::min(shortest, longest), std::max(shortest, longest)};
  if (!(traits.exposures.shortest > 0.0) || near(shortest, longest))
    throw Error(ErrorKind::device,
                fmt::format("the camera keeps to {:.4g} s whatever exposure it is asked for", longest),
                "switch its automatic exposure off; a camera without manual exposure cannot be used", name());
  if (!near(longest, wanted))
    traits.remarks.push_back(
        fmt::format("claims exposures up to {:.4g} s but keeps to {:.4g} s", wanted, longest));
  if (!near(shortest, claimed.shortest))
    traits.remarks.push_back(
        fmt::format("claims exposures from {:.4g} s but keeps to {:.4g} s", claimed.shortest, shortest));
}

void DrivenCamera::reconnect() {
  const microseconds begun = driver_->now();
  for (;;) {
    std::string reason, advice;
    try {
      const CameraTraits traits = connected();
      if (traits.size != traits_.size)
        throw Error(ErrorKind::device,
                    fmt::format("the camera came back with {}x{} pixels instead of {}x{}", traits.size.width,
                                traits.size.height, traits_.size.width, traits_.size.height),
                    "connect the camera that the measurement was begun with", name());
      ++reconnections_;
      return;
    } catch (const CameraLost& lost) {
      reason = lost.what();
      advice = lost.advice();
    }
    driver_->disconnect();
    isConnected_ = false;
    const microseconds away = driver_->now() - begun;
    if (away >= settings_.reconnectFor)
      throw Error(ErrorKind::device,
                  fmt::format("the camera has been gone for {:.0f} s: {}", inSeconds(away), reason),
                  (advice.empty() ? "check its cable and its power" : advice) +
                      ", then go on: every photograph so far is kept",
                  name());
    driver_->wait(settings_.reconnectPause);
  }
}

double DrivenCamera::expose(double seconds) {
  const double held = driver_->setExposure(seconds);
  if (!(held > 0.0) || held > tolerableRatio * seconds || seconds > tolerableRatio * held)
    throw Error(ErrorKind::device,
                fmt::format("the camera was asked to expose {:.4g} s and keeps to {:.4g} s", seconds, held),
                "switch its automatic exposure and its frame rate limit off", name());
  if (held != held_) toSkip_ = settings_.skipAfterChange;
  held_ = held;
  return held;
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
      throw Unusable{fmt::format("no photograph came within {:.3g} s", inSeconds(deadline - asked))};
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

RawFrame DrivenCamera::capture(const CaptureRequest& request) {
  std::string reason, advice;
  for (int attempt = 0; attempt < settings_.attempts; ++attempt) {
    if (attempt > 0) ++repeats_;
    try {
      if (!isConnected_) reconnect();
      const double seconds = expose(request.seconds);
      const DriverFrame taken = freshFrame(seconds);
      const Size size = photographSize(taken.frame.size, taken.frame.format);
      if (size != traits_.size || taken.frame.format != traits_.format)
        throw CameraLost(fmt::format("the photograph has {}x{} pixels as {} where {}x{} as {} were agreed",
                                     size.width, size.height, nameOf(taken.frame.format), traits_.size.width,
                                     traits_.size.height, nameOf(traits_.format)));
      return {photographOf(taken.frame, name()), photographBits(taken.frame), seconds};
    } catch (const Unusable& unusable) {
      reason = unusable.reason;
      advice.clear();
      // Once may be chance. Twice, and the camera may have forgotten how it was set up.
      isConnected_ = attempt == 0 && restarted();
    } catch (const CameraLost& lost) {
      reason = lost.what();
      advice = lost.advice();
      isConnected_ = false;
    }
    if (!isConnected_) driver_->disconnect();
  }
  throw Error(ErrorKind::device,
              fmt::format("{} attempts at a photograph failed: {}", settings_.attempts, reason),
              (advice.empty() ? "check the camera's cable and network card, and that no other program uses it"
                              : advice) +
                  ", then go on: every photograph so far is kept",
              name());
}

}  // namespace relucent
