// SPDX-License-Identifier: MIT
#include "relucent/reduction/pixel_use.h"

#include <fmt/format.h>

#include <charconv>

namespace relucent::reduction {

std::string toString(const PixelUse& use) {
  if (use.kind == PixelUse::Kind::binned) return fmt::format("1/{}", use.bin);
  return use.kind == PixelUse::Kind::all ? "all" : "auto";
}

std::optional<PixelUse> pixelUseFrom(std::string_view text) {
  if (text == "auto") return PixelUse{};
  if (text == "all") return PixelUse{PixelUse::Kind::all};
  if (!text.starts_with("1/")) return std::nullopt;
  int bin = 0;
  const char* end = text.data() + text.size();
  const auto [read, failure] = std::from_chars(text.data() + 2, end, bin);
  if (failure != std::errc() || read != end || bin < 1 || bin > mostBin) return std::nullopt;
  return PixelUse{PixelUse::Kind::binned, bin};
}

}  // namespace relucent::reduction
