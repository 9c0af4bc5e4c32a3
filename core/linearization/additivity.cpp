// SPDX-License-Identifier: MIT
#include "relucent/linearization/additivity.h"

#include <cmath>

namespace relucent::linearization {
namespace {

/// The larger by magnitude.
double worse(double a, double b) {
  return std::abs(b) > std::abs(a) ? b : a;
}

Message superpositionFinding(double excess, const std::string& projector) {
  const Argument share = as::share(std::abs(excess), as::decimals(0));
  return excess > 0.0 ? RELUCENT_MESSAGE(
                            "linearization.halves-brighter-than-whole",
                            "{}: two halves of a picture are {} % brighter than the whole; switch off the "
                            "dynamic iris, dynamic contrast and any picture mode that adapts to the content")
                            .with(projector, share)
                      : RELUCENT_MESSAGE(
                            "linearization.halves-darker-than-whole",
                            "{}: two halves of a picture are {} % darker than the whole; switch off the "
                            "dynamic iris, dynamic contrast and any picture mode that adapts to the content")
                            .with(projector, share);
}

}  // namespace

Additivity additivityOf(const ChannelSums& white, const ChannelSums& lights, const ChannelSums& groupInWhite,
                        const ChannelSums& groupLights) {
  Additivity result;
  for (std::size_t c = 0; c < 3; ++c) {
    if (!(groupLights[c] > 0.0) || !(white[c] > 0.0)) continue;
    double excess = groupInWhite[c] / groupLights[c];
    result.white = worse(result.white, excess - 1.0);
    result.superposition = worse(result.superposition, lights[c] * excess / white[c] - 1.0);
  }
  return result;
}

std::vector<Message> additivityFindings(const Additivity& additivity, const std::string& projector,
                                        double limit) {
  std::vector<Message> findings;
  const Argument share = as::share(std::abs(additivity.white), as::decimals(0));
  if (additivity.white > limit)
    findings.push_back(
        RELUCENT_MESSAGE(
            "linearization.white-brighter-than-colours",
            "{}: white is {} % brighter than red, green and blue together; switch off the white segment "
            "(often called brilliant colour or bright mode) and choose a picture mode for video or sRGB")
            .with(projector, share));
  if (additivity.white < -limit)
    findings.push_back(RELUCENT_MESSAGE("linearization.white-darker-than-colours",
                                        "{}: white is {} % darker than red, green and blue together; switch "
                                        "off power saving, colour management and dynamic picture modes")
                           .with(projector, share));
  if (std::abs(additivity.superposition) > limit)
    findings.push_back(superpositionFinding(additivity.superposition, projector));
  return findings;
}

}  // namespace relucent::linearization
