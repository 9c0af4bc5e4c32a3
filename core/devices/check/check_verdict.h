// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <string>

#include "relucent/base/message.h"

namespace relucent::devices {

/// What can be found out about a projector and the camera before it.
enum class Finding {
  // Which output the camera sees: devices/check/screen_proof.h
  screenSeen,
  screenMirrored,
  picturesLate,
  otherScreenSeen,
  screenNotSeen,
  // How long a picture takes: devices/check/latency.h
  pictureOut,
  whiteChanges,
  // How steady the light is: devices/check/light_check.h
  lightUnsteady,
  noBriefExposure,
  lampFlickers,
  colourWheel,
  rollingShutter,
  dithering,
  lightEven,
};
inline constexpr std::array allFindings{
    Finding::screenSeen,      Finding::screenMirrored, Finding::picturesLate, Finding::otherScreenSeen,
    Finding::screenNotSeen,   Finding::pictureOut,     Finding::whiteChanges, Finding::lightUnsteady,
    Finding::noBriefExposure, Finding::lampFlickers,   Finding::colourWheel,  Finding::rollingShutter,
    Finding::dithering,       Finding::lightEven};

/// A finding with what is told of it. Each uses those of the fields that it needs.
struct CheckVerdict {
  Finding finding = Finding::lightEven;
  double share = 0.0;     // of the light that changes; of the camera's view that sees the screen
  int count = 0;          // frames until a picture is out; photographs by which pictures come late
  double seconds = 0.0;   // that are waited for; of the exposure in which the light changes
  double frame = 0.0;     // seconds that the projector shows one picture
  std::string screen{};   // that the camera should see
  std::string instead{};  // that it sees

  bool operator==(const CheckVerdict&) const = default;
};

/// What was seen, and what to do.
Message messageOf(const CheckVerdict& verdict);

}  // namespace relucent::devices
