// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace relucent {

/// The text with letters from A to Z made small, whatever the locale.
inline std::string lowered(std::string_view text) {
  std::string lower(text);
  for (char& letter : lower)
    if (letter >= 'A' && letter <= 'Z') letter = static_cast<char>(letter - 'A' + 'a');
  return lower;
}

}  // namespace relucent
