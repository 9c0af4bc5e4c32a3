// SPDX-License-Identifier: MIT
#include "relucent/monitoring/finding.h"

#include <cmath>

namespace relucent::monitoring {
namespace {

/// Of shares of the view.
Message placeOf(double x, double y) {
  const int column = x < 1.0 / 3.0 ? 0 : x < 2.0 / 3.0 ? 1 : 2;
  const int row = y < 1.0 / 3.0 ? 0 : y < 2.0 / 3.0 ? 1 : 2;
  switch (3 * row + column) {
    case 0:
      return RELUCENT_ENGLISH_MESSAGE("monitoring.place-top-left", "at the top left");
    case 1:
      return RELUCENT_ENGLISH_MESSAGE("monitoring.place-top", "at the top");
    case 2:
      return RELUCENT_ENGLISH_MESSAGE("monitoring.place-top-right", "at the top right");
    case 3:
      return RELUCENT_ENGLISH_MESSAGE("monitoring.place-left", "on the left");
    case 4:
      return RELUCENT_ENGLISH_MESSAGE("monitoring.place-middle", "in the middle");
    case 5:
      return RELUCENT_ENGLISH_MESSAGE("monitoring.place-right", "on the right");
    case 6:
      return RELUCENT_ENGLISH_MESSAGE("monitoring.place-bottom-left", "at the bottom left");
    case 7:
      return RELUCENT_ENGLISH_MESSAGE("monitoring.place-bottom", "at the bottom");
    default:
      return RELUCENT_ENGLISH_MESSAGE("monitoring.place-bottom-right", "at the bottom right");
  }
}

Message colourOf(std::size_t channel) {
  if (channel == 0) return RELUCENT_ENGLISH_MESSAGE("monitoring.red", "red");
  if (channel == 1) return RELUCENT_ENGLISH_MESSAGE("monitoring.green", "green");
  return RELUCENT_ENGLISH_MESSAGE("monitoring.blue", "blue");
}

}  // namespace

Message sentenceOf(const Finding& finding) {
  const auto number = as::label(finding.projector.value_or(0) + 1);
  const auto percent = as::share(finding.amount, as::decimals(0));
  switch (finding.kind) {
    case FindingKind::moved:
      return RELUCENT_ENGLISH_MESSAGE("monitoring.moved",
                                      "The picture has moved by {} camera pixels since it was measured.")
          .with(as::pixels(finding.amount, as::decimals(1)));
    case FindingKind::faded:
      if (finding.channel)
        return RELUCENT_ENGLISH_MESSAGE("monitoring.channel-faded",
                                        "Projector {} gives {} % less {} light than when it was measured.")
            .with(number, percent, colourOf(*finding.channel));
      return RELUCENT_ENGLISH_MESSAGE("monitoring.faded",
                                      "Projector {} gives {} % less light than when it was measured.")
          .with(number, percent);
    case FindingKind::dark:
      return RELUCENT_ENGLISH_MESSAGE("monitoring.dark", "Hardly any light arrives from projector {}.")
          .with(number);
    case FindingKind::shadowed:
      return RELUCENT_ENGLISH_MESSAGE("monitoring.shadowed",
                                      "{} % of the light has been missing for a while {}.")
          .with(percent, placeOf(finding.x, finding.y));
    case FindingKind::unrecognised:
      return RELUCENT_ENGLISH_MESSAGE("monitoring.unrecognised",
                                      "The camera has not seen what is played for a while.");
  }
  return {};
}

Message sentenceOf(const FilledShadow& shadow) {
  return RELUCENT_ENGLISH_MESSAGE("monitoring.filled", "A shadow in the light of projector {} is filled {}.")
      .with(as::label(shadow.projector + 1), placeOf(shadow.x, shadow.y));
}

Message adviceOf(const Finding& finding) {
  switch (finding.kind) {
    case FindingKind::moved:
      return RELUCENT_ENGLISH_MESSAGE(
          "monitoring.advice-moved",
          "The show plays on with the calibration as it was. Put camera or projector "
          "back as they stood, or repair the calibration.");
    case FindingKind::faded:
      return RELUCENT_ENGLISH_MESSAGE(
          "monitoring.advice-faded",
          "The show plays on, a little dimmer. Repair the calibration; look after lamp, "
          "lens and filters.");
    case FindingKind::dark:
      return RELUCENT_ENGLISH_MESSAGE(
          "monitoring.advice-dark",
          "Look whether it is on, its shutter open and its cable in, and whether the "
          "camera's lens is covered. The calibration is safe.");
    case FindingKind::shadowed:
      return RELUCENT_ENGLISH_MESSAGE(
          "monitoring.advice-shadowed",
          "Take away what stands in the light or before the camera. If the surface has "
          "changed, repair the calibration; until then it stays as it was.");
    case FindingKind::unrecognised:
      return RELUCENT_ENGLISH_MESSAGE(
          "monitoring.advice-unrecognised",
          "Look whether something stands before the camera, whether it was turned, and "
          "whether the projectors show the show. The calibration is safe.");
  }
  return {};
}

}  // namespace relucent::monitoring
