// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/progress.h"
#include "compensation/direct_light.h"
#include "compensation/target.h"

namespace relucent {

/// Why a camera pixel cannot show what is wanted there; of several reasons the first in this order.
enum class Uncorrectable : std::uint8_t {
  none,       // it can, as far as T tells
  outside,    // nothing is wanted there
  unlit,      // not usable: too little light of the projector, or its measurement did not hold
  shadowed,   // lit by indirect light alone
  seenTwice,  // another place of the view shows the same projector pixels
  tooDark,    // T 1 + e lies below what is wanted in some channel: the surface is too dark
  tooBright,  // e lies above it: black level and room light are too bright
};
inline constexpr std::array allReasons{
    Uncorrectable::none,      Uncorrectable::outside, Uncorrectable::unlit,    Uncorrectable::shadowed,
    Uncorrectable::seenTwice, Uncorrectable::tooDark, Uncorrectable::tooBright};
/// "correctable", "outside", "unlit", "shadowed", "seen_twice", "too_dark", "too_bright".
std::string_view toString(Uncorrectable reason);

struct UncorrectableSettings {
  DirectLightSettings direct;
  double leastDirectShare = relucent::leastDirectShare;  // shadowed: less of the flood image is direct
  /// Seen twice: the two places are this far apart, as a share of the camera's larger side, at least three
  /// pixels: further than defocus and the camera's pixels spread one projector pixel (direct.reach).
  double apart = 1.0 / 32.0;
  /// The brighter place counts too where the other has at least this share of its light: then neither can be
  /// given up for the other.
  double comparable = 0.5;
};
std::vector<std::string> problems(const UncorrectableSettings& settings);

/// Per camera pixel, of all cameras, whether it can show what is wanted, and why not.
/// Seen twice is decided so: let j be the projector pixel that lights camera pixel i most, and i' the pixel
/// of the same camera that j lights most. i and i' far apart: i has no light of its own. Shapes: one value a
/// camera pixel.  Source: core/compensation/README.md.  Throws: Cancelled.
std::vector<Uncorrectable> uncorrectableMap(const MeasuredVenue& venue, const Target& target,
                                            const UncorrectableSettings& settings, Progress& progress);

/// What share of the pixels where something is wanted has each reason, in the order of allReasons.
std::array<double, allReasons.size()> sharesOf(const std::vector<Uncorrectable>& map);

}  // namespace relucent
