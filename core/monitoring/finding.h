// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>

#include "relucent/base/enum_names.h"
#include "relucent/base/message.h"

namespace relucent::monitoring {

/// What can have become of a venue while its show plays. Names: as health.json has them.
enum class FindingKind { moved, faded, dark, shadowed, unrecognised };
inline constexpr EnumName<FindingKind> findingKindNames[]{
    {FindingKind::moved, "moved", "the camera looks elsewhere, or the picture lies elsewhere"},
    {FindingKind::faded, "faded", "a projector's light is weaker than it was measured"},
    {FindingKind::dark, "dark", "a projector gives hardly any light"},
    {FindingKind::shadowed, "shadowed", "light is missing on a part of the picture"},
    {FindingKind::unrecognised, "unrecognised", "the camera does not see what is played"}};
constexpr EnumNames<FindingKind> namesOf(FindingKind) {
  return {"kind of finding", findingKindNames};
}

/// What lasts, and since when it has been known.
struct Finding {
  FindingKind kind = FindingKind::moved;
  std::optional<std::size_t> projector{};  // whose; none: it is of the view
  std::optional<std::size_t> channel{};    // of its light: 0 red, 1 green, 2 blue; none: all of it
  double amount = 0.0;                     // pixels that it moved; share of light that is missing
  double x = 0.0, y = 0.0;  // pixels, right and down; or the middle of the shadow as shares of the view
  double since = 0.0;       // seconds, of the photographs' clock
};

/// A shadow that other projectors fill.
struct FilledShadow {
  std::size_t projector = 0;  // whose light does not arrive
  double x = 0.0, y = 0.0;    // its middle as shares of the camera's view
  std::size_t cells = 0;      // of that projector, see ShadowMap
};
Message sentenceOf(const FilledShadow& shadow);

/// What happened, in one sentence.
Message sentenceOf(const Finding& finding);
/// What is still safe, and what to do.
Message adviceOf(const Finding& finding);

}  // namespace relucent::monitoring
