// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <chrono>
#include <cmath>
#include <set>
#include <vector>

#include "relucent/devices/sensor_frame.h"
#include "relucent/rig/rig.h"

namespace relucent::test {

enum class Fault {
  none,
  lostPackets,      // parts of a photograph are missing
  noFrame,          // none comes
  otherSize,        // a row is missing
  staleFirst,       // the photograph before arrives once more, then the new one
  staleOnly,        // the photograph before arrives once more, and nothing else
  sameNumber,       // the photograph before comes late enough to look new, under its old number
  unplugged,        // the camera, while it exposes
  cutExposure,      // from then on the camera keeps to less than half of a long exposure
  slightlyCut,      // ... to four fifths of it
  cutUnseen,        // ... to four fifths of it, but reads back and takes the time that was asked for
  flatBattery,      // it was low for some shots, and dies while a photograph is exposed
  fullCard,         // no photograph is taken
  lateFile,         // a still camera writes it when nobody waits for it any more
  vanishingScreen,  // loses its picture in the middle of a frame
};

struct Disturbance {
  Fault fault = Fault::none;
  std::vector<int> shots{};      // in whose first photograph it strikes, ...
  int photographs = 1;           // ... and how many it spoils there, one after the other
  std::chrono::seconds lasts{};  // how long a camera or a card stays away
  rig::ExposureRange claimed{1.0 / 8000.0, 4.0}, kept{1.0 / 8000.0, 4.0};
};

inline constexpr double longExposure = 1.0 / 8.0, shortExposure = 1.0 / 80.0;

/// What the devices of one run share: the simulated ones, what disturbs them, and what came of it.
class DisturbedVenue {
 public:
  DisturbedVenue(rig::Rig simulated, Disturbance disturbance)
      : simulated_(std::move(simulated)), disturbance_(std::move(disturbance)) {}

  const Disturbance& disturbance() const { return disturbance_; }
  rig::Projector& projector() { return *simulated_.projectors.front(); }
  Size size() const { return simulated_.cameras.front()->size(); }

  /// The name of the next photograph: the key of its noise, which reaches no real camera.
  void ask(const rig::CaptureRequest& request) {
    request_ = request;
    photographed_.insert(request.shot.number);
    const auto& shots = disturbance_.shots;
    if (std::find(shots.begin(), shots.end(), request.shot.number) == shots.end()) return;
    if (struck_.insert(request.shot.number).second) toSpoil_ = disturbance_.photographs;
  }
  /// Whether this fault spoils the photograph that is being taken; counted.
  bool strikes(Fault fault) {
    if (fault != disturbance_.fault || toSpoil_ == 0) return false;
    --toSpoil_;
    ++spoilt_;
    return true;
  }
  bool isWithin20Shots(Fault fault) const {
    return fault == disturbance_.fault && request_.shot.number + 20 >= disturbance_.shots.front();
  }
  /// The exposure time that the camera keeps to when it is asked for one.
  double kept(double seconds) {
    const Fault fault = struck_.empty() || seconds < longExposure ? Fault::none : disturbance_.fault;
    double share = 1.0;
    if (fault == Fault::cutExposure) share = 0.4;
    if (fault == Fault::slightlyCut || fault == Fault::cutUnseen) share = 0.8;
    if (share < 1.0) ++spoilt_;
    return std::clamp(share * seconds, disturbance_.kept.shortest, disturbance_.kept.longest);
  }

  void show(const image::Image& picture) {
    projector().show(picture);
    stayedVisible_ = true;
  }
  bool stayedVisible() const { return stayedVisible_; }

  /// 12 bits a sample, exposed now.
  devices::SensorFrame photograph(double seconds) {
    image::Image signal = look(seconds);
    if (strikes(Fault::vanishingScreen)) {
      projector().show(image::Image(projector().size(), 3));
      stayedVisible_ = false;
      // The rows of a rolling shutter that were still to come.
      const image::Image dark = look(seconds);
      const auto half = static_cast<std::ptrdiff_t>(signal.data().size() / 2);
      std::copy(dark.data().begin() + half, dark.data().end(), signal.data().begin() + half);
    }
    devices::SensorFrame frame{signal.size(), {devices::SensorLayout::rgb, 12}, {}};
    for (float value : signal.data()) {
      const auto code = static_cast<unsigned>(std::lround(value * 4095.0f));
      frame.bytes.push_back(static_cast<std::uint8_t>(code & 0xffu));
      frame.bytes.push_back(static_cast<std::uint8_t>(code >> 8));
    }
    return frame;
  }

  /// Photographs that were spoilt, and the numbers of the shots that were not read from a log.
  int spoilt() const { return spoilt_; }
  const std::set<int>& photographed() const { return photographed_; }
  int delivered = 0;  // frames that came out of the camera's driver
  int captures = 0;   // photographs that were used

 private:
  image::Image look(double seconds) {
    return simulated_.cameras.front()->capture({request_.shot, request_.exposure, seconds}).signal;
  }

  rig::Rig simulated_;
  Disturbance disturbance_;
  rig::CaptureRequest request_;
  std::set<int> photographed_, struck_;
  int toSpoil_ = 0, spoilt_ = 0;
  bool stayedVisible_ = false;
};

}  // namespace relucent::test
