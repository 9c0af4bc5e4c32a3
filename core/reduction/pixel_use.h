// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace relucent::reduction {

/// How many of a camera's pixels somebody wants to be used.
struct PixelUse {
  enum class Kind {
    automatic,  // about as many of what is lit as the projectors have pixels
    all,        // every one, lit or not
    binned      // of what is lit, bin x bin become one
  };
  Kind kind = Kind::automatic;
  int bin = 1;  // of Kind::binned

  bool operator==(const PixelUse&) const = default;
};

inline constexpr int mostBin = 16;

/// "auto", "all", "1/3": three by three become one.
std::string toString(const PixelUse& use);
/// The other way round; none if `text` is none of these, or more than mostBin.
std::optional<PixelUse> pixelUseFrom(std::string_view text);

}  // namespace relucent::reduction
