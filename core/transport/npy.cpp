// SPDX-License-Identifier: MIT
#include "relucent/transport/npy.h"

#include <fmt/format.h>

#include <charconv>
#include <cstring>

namespace relucent::transport {
namespace {

constexpr char magic[] = "\x93NUMPY";
constexpr std::size_t magicBytes = 6;
// Enough for any array of ours; a larger header is not one.
constexpr std::size_t longestHeader = 4096;

/// The text between `key` and the end of its value in a .npy dictionary.
std::string valueOf(const std::string& dictionary, const std::string& key, char open, char close) {
  std::size_t at = dictionary.find("'" + key + "'");
  if (at == std::string::npos) return {};
  std::size_t begin = dictionary.find(open, at + key.size() + 2);
  std::size_t end = begin == std::string::npos ? begin : dictionary.find(close, begin + 1);
  return end == std::string::npos ? std::string() : dictionary.substr(begin + 1, end - begin - 1);
}

bool parseShape(const std::string& text, std::vector<std::uint64_t>& shape) {
  const char* at = text.data();
  const char* end = at + text.size();
  while (true) {
    while (at != end && (*at == ' ' || *at == ',')) ++at;
    if (at == end) return true;
    std::uint64_t length = 0;
    auto [next, code] = std::from_chars(at, end, length);
    if (code != std::errc() || length > (std::uint64_t{1} << 48)) return false;
    shape.push_back(length);
    at = next;
  }
}

}  // namespace

std::uint64_t NpyHeader::count() const {
  std::uint64_t count = 1;
  for (std::uint64_t length : shape) count *= length;
  return count;
}

std::size_t NpyHeader::itemBytes() const {
  std::size_t bytes = 0;
  if (type.size() > 2) std::from_chars(type.data() + 2, type.data() + type.size(), bytes);
  return bytes;
}

std::string npyText(const NpyHeader& header) {
  std::string shape;
  for (std::uint64_t length : header.shape) shape += fmt::format("{}, ", length);
  if (header.shape.size() > 1) shape.resize(shape.size() - 2);
  std::string dictionary =
      fmt::format("{{'descr': '{}', 'fortran_order': False, 'shape': ({}), }}", header.type, shape);
  constexpr std::size_t prefix = magicBytes + 4;
  dictionary.append(63 - (prefix + dictionary.size()) % 64, ' ');
  dictionary += '\n';
  std::string text(magic, magicBytes);
  text += {'\x01', '\x00', static_cast<char>(dictionary.size() & 0xff),
           static_cast<char>(dictionary.size() >> 8)};
  return text + dictionary;
}

std::optional<std::string> readNpyDictionary(const ReadBytes& read) {
  char prefix[magicBytes + 2];
  if (!read(prefix, sizeof(prefix)) || std::memcmp(prefix, magic, magicBytes) != 0) return {};
  unsigned char length[4] = {};
  bool first = prefix[magicBytes] == 1;
  if (!read(reinterpret_cast<char*>(length), first ? 2 : 4)) return {};
  std::size_t bytes = length[0] + 256u * length[1] + 65536u * length[2] + 16777216u * length[3];
  if (bytes > longestHeader) return {};
  std::string dictionary(bytes, '\0');
  if (!read(dictionary.data(), bytes)) return {};
  return dictionary;
}

std::optional<NpyHeader> parseNpyDictionary(const std::string& dictionary) {
  NpyHeader header;
  header.type = valueOf(dictionary, "descr", '\'', '\'');
  bool cOrder = dictionary.find("'fortran_order': False") != std::string::npos;
  if (!cOrder || header.itemBytes() == 0) return {};
  if (!parseShape(valueOf(dictionary, "shape", '(', ')'), header.shape)) return {};
  return header;
}

}  // namespace relucent::transport
