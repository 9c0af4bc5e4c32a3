// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "relucent/base/progress.h"
#include "relucent/linearization/test_light.h"

namespace relucent::linearization {

/// Deviations of a projector's light from additivity, and the weights for its ramps.
struct Additivity {
  double white = 0.0;          // (W-K) / ((R-K) + (G-K) + (B-K)) - 1, worst camera channel by magnitude
  double superposition = 0.0;  // (H-K + H'-K) / (W-K) - 1 for a random half H and its complement H'
  std::array<LightWeights, 3> channelWeights;  // for light of each projector channel
  LightWeights whiteWeights;
};

/// Shots: black, white, red, green, blue, white, black, then two random halves and their complements.
/// Throws: Error{input} if no camera sees one of the projector's channels.
Additivity measureAdditivity(const LightMeter& meter, std::size_t projector, std::uint64_t seed,
                             Progress& progress);

/// Findings about deviations above `limit`: the likely cause and what to switch off.
std::vector<Message> additivityFindings(const Additivity& additivity, const std::string& projector,
                                        double limit);

}  // namespace relucent::linearization
