// SPDX-License-Identifier: MIT
#include "devices/check_verdict.h"

#include <fmt/format.h>

namespace relucent {

std::string sentence(const CheckVerdict& verdict) {
  const double percent = 100.0 * verdict.share, milliseconds = 1000.0 * verdict.seconds,
               frame = 1000.0 * verdict.frame;
  switch (verdict.finding) {
    case Finding::screenSeen:
      return fmt::format("The camera sees {}: {:.0f} % of its view follow the test pattern.", verdict.screen,
                         percent);
    case Finding::screenMirrored:
      return "The picture appears mirrored. If it is not meant to (rear projection, a mirror), switch that "
             "off in the projector's menu.";
    case Finding::picturesLate:
      return fmt::format("Pictures come late, by {} {}: the latency has to be measured and waited for.",
                         verdict.count, verdict.count == 1 ? "photograph" : "photographs");
    case Finding::otherScreenSeen:
      return fmt::format("The camera sees {} and not {}.", verdict.instead, verdict.screen);
    case Finding::screenNotSeen:
      return fmt::format("The camera does not see {}.", verdict.screen);
    case Finding::pictureOut:
      return fmt::format("A picture is out {} {} after it is sent: {:.0f} ms are waited for.", verdict.count,
                         verdict.count == 1 ? "frame" : "frames", milliseconds);
    case Finding::whiteChanges:
      return fmt::format(
          "White changes by {:.1f} % from photograph to photograph: expose whole frames of the projector, "
          "multiples of {:.2f} ms, and switch its dynamic brightness off.",
          percent, frame);
    case Finding::lightUnsteady:
      return fmt::format(
          "The light changes by {:.1f} % between exposures of whole frames: let the lamp warm up, and switch "
          "dynamic brightness and lamps in the room off.",
          percent);
    case Finding::noBriefExposure:
      return "The camera cannot expose for a part of a frame, or sees too little then: flicker within a "
             "frame cannot be told.";
    case Finding::lampFlickers:
      return fmt::format(
          "The lamp flickers within a frame, by {:.0f} % in {:.1f} ms: expose whole frames, multiples of "
          "{:.2f} ms.",
          percent, milliseconds, frame);
    case Finding::colourWheel:
      return fmt::format(
          "The colours come one after the other, as through a colour wheel ({:.0f} % in {:.1f} ms): expose "
          "whole frames, multiples of {:.2f} ms.",
          percent, milliseconds, frame);
    case Finding::rollingShutter:
      return fmt::format(
          "The camera exposes its rows one after the other (rolling shutter): brief exposures have bands of "
          "{:.0f} %. Expose whole frames, multiples of {:.2f} ms.",
          percent, frame);
    case Finding::dithering:
      return fmt::format(
          "The projector mixes greys in time, pixel by pixel ({:.0f} %): expose several whole frames, and "
          "switch its smoothing and 3D modes off.",
          percent);
    case Finding::lightEven:
      return "The light is even: no flicker, colour wheel, bands or dithering is seen.";
  }
  return {};
}

}  // namespace relucent
