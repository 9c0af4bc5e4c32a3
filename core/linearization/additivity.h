// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <string>
#include <vector>

#include "relucent/base/message.h"
#include "relucent/linearization/mosaic.h"

namespace relucent::linearization {

/// Deviations of a projector's light from additivity.
struct Additivity {
  double white = 0.0;          // of one group: (H-K) / ((R-K) + (G-K) + (B-K)) - 1, worst camera channel
  double superposition = 0.0;  // all lights over white, if colours added up as they do in one group, - 1
};

/// Sums over well-lit camera values, less black and over the lamp's power, per camera channel.
using ChannelSums = std::array<double, 3>;

/// From white and the lights that make it up, and from the first group in white and its three lights;
/// both pairs over values of their own.
Additivity additivityOf(const ChannelSums& white, const ChannelSums& lights, const ChannelSums& groupInWhite,
                        const ChannelSums& groupLights);

/// Findings about deviations above `limit`: the likely cause and what to switch off.
std::vector<Message> additivityFindings(const Additivity& additivity, const std::string& projector,
                                        double limit);

}  // namespace relucent::linearization
