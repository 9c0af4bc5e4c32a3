// SPDX-License-Identifier: MIT
#include "relucent/devices/check/check_verdict.h"

namespace relucent::devices {

Message messageOf(const CheckVerdict& verdict) {
  const Argument share = as::share(verdict.share, as::decimals(0));
  const Argument smallShare = as::share(verdict.share, as::decimals(1));
  const Argument time = as::milliseconds(verdict.seconds, as::decimals(1));
  const Argument frame = as::milliseconds(verdict.frame, as::decimals(2));
  switch (verdict.finding) {
    case Finding::screenSeen:
      return RELUCENT_MESSAGE("check.screen-seen",
                              "The camera sees {}: {} % of its view follow the test pattern.")
          .with(verdict.screen, share);
    case Finding::screenMirrored:
      return RELUCENT_MESSAGE("check.screen-mirrored",
                              "The picture appears mirrored. If it is not meant to (rear projection, a "
                              "mirror), switch that off in the projector's menu.");
    case Finding::picturesLate:
      return RELUCENT_PLURAL_MESSAGE(
                 "check.pictures-late",
                 "Pictures arrive {} photographs late: measure the latency, so that it is waited for.",
                 "Pictures arrive {} photograph late: measure the latency, so that it is waited for.")
          .with(verdict.count);
    case Finding::otherScreenSeen:
      return RELUCENT_MESSAGE("check.other-screen-seen", "The camera sees {} and not {}.")
          .with(verdict.instead, verdict.screen);
    case Finding::screenNotSeen:
      return RELUCENT_MESSAGE("check.screen-not-seen", "The camera does not see {}.").with(verdict.screen);
    case Finding::pictureOut:
      return RELUCENT_MESSAGE("check.picture-takes",
                              "A picture takes {} ms to appear: each one is waited for that long.")
          .with(as::milliseconds(verdict.seconds, as::decimals(0)));
    case Finding::whiteChanges:
      return RELUCENT_MESSAGE("check.white-changes",
                              "White changes by {} % from photograph to photograph: expose whole frames of "
                              "the projector, multiples of {} ms, and switch its dynamic brightness off.")
          .with(smallShare, frame);
    case Finding::lightUnsteady:
      return RELUCENT_MESSAGE("check.light-unsteady",
                              "The light changes by {} % between exposures of whole frames: let the lamp "
                              "warm up, and switch off dynamic brightness and the lamps in the room.")
          .with(smallShare);
    case Finding::noBriefExposure:
      return RELUCENT_MESSAGE("check.no-brief-exposure",
                              "The camera cannot expose for a part of a frame, or sees too little then: "
                              "flicker within a frame cannot be detected.");
    case Finding::lampFlickers:
      return RELUCENT_MESSAGE("check.lamp-flickers",
                              "The lamp flickers within a frame, by {} % in {} ms: expose whole frames, "
                              "multiples of {} ms.")
          .with(share, time, frame);
    case Finding::colourWheel:
      return RELUCENT_MESSAGE("check.colour-wheel",
                              "The colours come one after the other, as through a colour wheel ({} % in {} "
                              "ms): expose whole frames, multiples of {} ms.")
          .with(share, time, frame);
    case Finding::rollingShutter:
      return RELUCENT_MESSAGE("check.rolling-shutter",
                              "The camera exposes its rows one after the other (rolling shutter): brief "
                              "exposures have bands of {} %. Expose whole frames, multiples of {} ms.")
          .with(share, frame);
    case Finding::dithering:
      return RELUCENT_MESSAGE("check.dithering",
                              "The projector mixes greys in time, pixel by pixel ({} %): expose several "
                              "whole frames, and switch its smoothing and 3D modes off.")
          .with(share);
    case Finding::lightEven:
      return RELUCENT_MESSAGE("check.light-even",
                              "The light is even: no flicker, colour wheel, bands or dithering is seen.");
  }
  return {};
}

}  // namespace relucent::devices
