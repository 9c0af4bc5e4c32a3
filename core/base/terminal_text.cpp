// SPDX-License-Identifier: MIT
#include "relucent/base/terminal_text.h"

#include <fmt/format.h>

#include <cstdint>

namespace relucent {
namespace {

std::uint8_t byteAt(std::string_view text, std::size_t at) {
  return static_cast<std::uint8_t>(text[at]);
}

/// Bytes of the UTF-8 character that begins there; 0: none does. Source: RFC 3629.
std::size_t characterLength(std::string_view text, std::size_t at) {
  const std::uint8_t first = byteAt(text, at);
  if (first < 0x80) return 1;
  const std::size_t length = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
  if (first < 0xc2 || first > 0xf4 || at + length > text.size()) return 0;
  std::uint32_t code = first & (0xffu >> (length + 1));
  for (std::size_t i = 1; i < length; ++i) {
    if ((byteAt(text, at + i) & 0xc0) != 0x80) return 0;
    code = code << 6 | (byteAt(text, at + i) & 0x3fu);
  }
  constexpr std::uint32_t shortest[]{0, 0, 0x80, 0x800, 0x10000};
  const bool isSurrogate = code >= 0xd800 && code < 0xe000;
  return code < shortest[length] || code > 0x10ffff || isSurrogate ? 0 : length;
}

bool isControl(std::string_view text, std::size_t at, std::size_t length) {
  const std::uint8_t first = byteAt(text, at);
  if (length == 1) return first < 0x20 || first == 0x7f;
  return length == 2 && first == 0xc2 && byteAt(text, at + 1) < 0xa0;
}

std::string escaped(std::string_view text, std::string_view kept) {
  std::string result;
  result.reserve(text.size());
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t length = characterLength(text, at);
    const std::size_t bytes = length > 0 ? length : 1;
    const bool stays = kept.find(text[at]) != std::string_view::npos;
    if (length > 0 && (stays || !isControl(text, at, length)))
      result += text.substr(at, bytes);
    else
      for (std::size_t i = 0; i < bytes; ++i) result += fmt::format("\\x{:02x}", byteAt(text, at + i));
    at += bytes;
  }
  return result;
}

}  // namespace

std::string forTerminal(std::string_view text) {
  return escaped(text, "\t\n");
}

std::string forLogLine(std::string_view text) {
  return escaped(text, "\t");
}

}  // namespace relucent
