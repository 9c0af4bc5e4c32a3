// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "relucent/base/enum_names.h"
#include "relucent/base/progress.h"
#include "relucent/compensation/direct_light.h"
#include "relucent/compensation/target.h"

namespace relucent::compensation {

/// Why a camera pixel cannot show the wanted value; of several reasons the first in this order.
enum class Uncorrectable : std::uint8_t {
  none,       // it can, according to T
  outside,    // outside the content
  unlit,      // not usable: too little light from the projector, or its measurement failed verification
  shadowed,   // lit by indirect light alone
  seenTwice,  // another part of the view shows the same projector pixels
  tooDark,    // T 1 + e is below the wanted value in some channel: the surface is too dark
  tooBright,  // e is above it: black level and room light are too bright
};
inline constexpr std::array allReasons{
    Uncorrectable::none,      Uncorrectable::outside, Uncorrectable::unlit,    Uncorrectable::shadowed,
    Uncorrectable::seenTwice, Uncorrectable::tooDark, Uncorrectable::tooBright};
inline constexpr EnumName<Uncorrectable> uncorrectableNames[]{
    {Uncorrectable::none, "correctable"},     {Uncorrectable::outside, "outside"},
    {Uncorrectable::unlit, "unlit"},          {Uncorrectable::shadowed, "shadowed"},
    {Uncorrectable::seenTwice, "seen_twice"}, {Uncorrectable::tooDark, "too_dark"},
    {Uncorrectable::tooBright, "too_bright"}};
constexpr EnumNames<Uncorrectable> namesOf(Uncorrectable) {
  return {"reason", uncorrectableNames};
}

struct UncorrectableSettings {
  DirectLightSettings direct;
  double leastDirectShare =
      relucent::compensation::leastDirectShare;  // shadowed: less of the flood image is direct
  /// Seen twice: the two positions are at least this far apart, as a share of the camera's larger side, at
  /// least three pixels: further than defocus and the camera's pixels spread one projector pixel
  /// (direct.reach).
  double apart = 1.0 / 32.0;
  /// The brighter position counts too if the other has at least this share of its light: then neither can be
  /// given priority.
  double comparable = 0.5;
};
std::vector<Message> problems(const UncorrectableSettings& settings);

/// Per camera pixel, of all cameras, whether it can show what is wanted, and why not.
/// Seen twice: let j be the projector pixel that lights camera pixel i most, and i' the pixel of the same
/// camera that j lights most. i and i' far apart: i has no light of its own. Shapes: one value a camera
/// pixel.  Source: core/compensation/README.md.  Throws: Cancelled.
std::vector<Uncorrectable> uncorrectableMap(const MeasuredVenue& venue, const Target& target,
                                            const UncorrectableSettings& settings, Progress& progress);

/// Share of the content's pixels with each reason, in the order of allReasons.
std::array<double, allReasons.size()> sharesOf(const std::vector<Uncorrectable>& map);

/// Shares of the content in the first camera's view that cannot be reached, by the projectors' limits alone:
/// with Prediction::reachable they add up to one. What no projector lights is too dark.
struct UnreachableShares {
  double tooDark = 0.0, tooBright = 0.0;
};
UnreachableShares unreachableShares(const MeasuredVenue& venue, const Target& target);

}  // namespace relucent::compensation
