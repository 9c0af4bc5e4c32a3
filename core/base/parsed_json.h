// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

namespace relucent {

/// Deeper than any document of ours nests. The JSON library copies and writes what is nested by calling
/// itself, so that a file of some ten thousand brackets would take all of the stack.
inline constexpr int deepestJson = 64;

/// The document in a text. `Json`: the library's type, whom only the files that may know it name.
/// Throws: Json::exception if it is none, or nests deeper than deepestJson.
template <typename Json>
Json parsedJson(std::string_view text) {
  const auto isShallow = [](int depth, typename Json::parse_event_t, Json&) {
    if (depth > deepestJson) throw Json::out_of_range::create(408, "it nests too deep", nullptr);
    return true;
  };
  return Json::parse(text.begin(), text.end(), isShallow);
}

}  // namespace relucent
