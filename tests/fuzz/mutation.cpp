// SPDX-License-Identifier: MIT
#include "fuzz/mutation.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <cstdint>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>

#include "relucent/base/parsed_json.h"

namespace relucent::fuzz {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array<std::int64_t, 20> oddNumbers{
    0,    1,     -1,    2,     3,        7,          127,         128,        255,        256,
    -128, 32767, 65535, 65536, 16777216, 2147483647, -2147483648, 4294967295, 4294967296, INT64_MAX};
constexpr std::array oddTexts{"0",
                              "-1",
                              "1e308",
                              "-1e308",
                              "1e-320",
                              "0.5",
                              "nan",
                              "inf",
                              "65536",
                              "4294967296",
                              "18446744073709551615",
                              "1e1000",
                              "9223372036854775808",
                              "00000000000000000001",
                              "0x10",
                              "",
                              "1,5",
                              "-0"};

std::size_t anyIn(Random& random, std::size_t count) {
  return static_cast<std::size_t>(random.below(count));
}

/// A place and a length of at least one, mostly short; nothing of an empty text.
struct Piece {
  std::size_t begin = 0, length = 0;
};
Piece pieceOf(const std::string& bytes, Random& random) {
  if (bytes.empty()) return {};
  const std::size_t begin = anyIn(random, bytes.size());
  const std::size_t most = bytes.size() - begin;
  const std::size_t length =
      random.below(4) > 0 ? std::min<std::size_t>(most, 1 + anyIn(random, 16)) : 1 + anyIn(random, most);
  return {begin, length};
}

void writeNumber(std::string& bytes, std::size_t at, Random& random) {
  const std::size_t width = std::size_t{1} << random.below(4);
  if (bytes.size() < at + width) return;
  std::int64_t value = oddNumbers[anyIn(random, oddNumbers.size())];
  std::array<char, 8> raw{};
  std::memcpy(raw.data(), &value, sizeof value);
  if (random.below(3) == 0) {
    // What is there, a little more or less.
    std::memset(raw.data(), 0, sizeof value);
    std::memcpy(raw.data(), bytes.data() + at, width);
    std::memcpy(&value, raw.data(), sizeof value);
    value = static_cast<std::int64_t>(static_cast<std::uint64_t>(value) + random.below(9) - 4);
    std::memcpy(raw.data(), &value, sizeof value);
  }
  if (random.below(2) == 0) std::reverse(raw.begin(), raw.begin() + static_cast<std::ptrdiff_t>(width));
  bytes.replace(at, width, raw.data(), width);
}

/// One of the numbers that are written out in it becomes another.
void writeText(std::string& bytes, Random& random) {
  const std::size_t from = bytes.empty() ? 0 : anyIn(random, bytes.size());
  std::size_t begin = from;
  while (begin < bytes.size() && std::isdigit(static_cast<unsigned char>(bytes[begin])) == 0) ++begin;
  std::size_t end = begin;
  while (end < bytes.size() && std::isdigit(static_cast<unsigned char>(bytes[end])) != 0) ++end;
  bytes.replace(begin, end - begin, oddTexts[anyIn(random, oddTexts.size())]);
}

void collect(Json& json, std::vector<Json*>& nodes) {
  nodes.push_back(&json);
  if (json.is_structured())
    for (Json& child : json) collect(child, nodes);
}

Json oddJson(Random& random) {
  switch (random.below(12)) {
    case 0:
      return nullptr;
    case 1:
      return Json::array();
    case 2:
      return Json::object();
    case 3:
      return "";
    case 4:
      return "../../etc/passwd";
    case 5:
      return std::string(1 + anyIn(random, 5000), 'a');
    case 6:
      return 1e308;
    case 7:
      return -0.5;
    case 8:
      return random.below(2) == 0;
    case 9:
      return std::numeric_limits<std::uint64_t>::max();
    default:
      return oddNumbers[anyIn(random, oddNumbers.size())];
  }
}

}  // namespace

Mutator::Mutator(const FuzzTarget& target) : target_(target), seeds_(target.seeds()) {}

std::string Mutator::input(Random& random) const {
  return changed(seeds_[anyIn(random, seeds_.size())], random);
}

std::string Mutator::changed(std::string bytes, Random& random) const {
  if (target_.form == Form::json && random.below(4) > 0) {
    bytes = changedJson(bytes, random);
  } else if (target_.form == Form::jsonLine && random.below(4) > 0) {
    const std::size_t line = std::min(bytes.find('\n'), bytes.size());
    bytes = changedJson(bytes.substr(0, line), random) + bytes.substr(line);
  } else {
    const std::uint64_t changes = 1 + random.below(random.below(3) == 0 ? 12 : 3);
    for (std::uint64_t i = 0; i < changes; ++i) changeBytes(bytes, random);
  }
  if (bytes.size() > longestInput) bytes.resize(longestInput);
  return bytes;
}

void Mutator::changeBytes(std::string& bytes, Random& random) const {
  const Piece piece = pieceOf(bytes, random);
  const std::size_t place = bytes.empty() ? 0 : anyIn(random, bytes.size() + 1);
  switch (random.below(13)) {
    case 0:
      if (piece.length > 0)
        bytes[piece.begin] = static_cast<char>(bytes[piece.begin] ^ static_cast<char>(1U << random.below(8)));
      break;
    case 1:
      if (piece.length > 0) bytes[piece.begin] = static_cast<char>(random.below(256));
      break;
    case 2:
      bytes.erase(piece.begin, piece.length);
      break;
    case 3:
      bytes.resize(place);
      break;
    case 4:
      bytes.insert(place, bytes.substr(piece.begin, piece.length));
      break;
    case 5: {
      const std::string copied = bytes.substr(piece.begin, piece.length);
      bytes.replace(place, copied.size(), copied);
      break;
    }
    case 6:
    case 7:
      writeNumber(bytes, piece.begin, random);
      break;
    case 8:
      writeText(bytes, random);
      break;
    case 9: {
      const std::string& other = seeds_[anyIn(random, seeds_.size())];
      const Piece taken = pieceOf(other, random);
      bytes.replace(place, random.below(2) * taken.length, other.substr(taken.begin, taken.length));
      break;
    }
    case 10:
      if (!target_.words.empty()) {
        const std::string& word = target_.words[anyIn(random, target_.words.size())];
        bytes.replace(place, random.below(2) * word.size(), word);
      }
      break;
    case 11: {
      std::string more(random.below(20), '\0');
      for (char& byte : more) byte = static_cast<char>(random.below(256));
      bytes.insert(place, more);
      break;
    }
    default: {
      if (piece.length == 0 || random.below(8) != 0) break;
      // Deep nesting and long lists.
      const std::string repeated = bytes.substr(piece.begin, std::min<std::size_t>(piece.length, 24));
      std::string many;
      for (std::uint64_t i = std::uint64_t{1} << random.below(17); i > 0 && many.size() < longestInput; --i)
        many += repeated;
      bytes.insert(piece.begin, many);
      break;
    }
  }
}

std::string Mutator::changedJson(const std::string& text, Random& random) const {
  Json json;
  try {
    json = parsedJson<Json>(text);
  } catch (const Json::exception&) {
    return text;
  }
  constexpr const char* nested = "relucent nested";
  const std::uint64_t changes = 1 + random.below(3);
  for (std::uint64_t i = 0; i < changes; ++i) {
    std::vector<Json*> nodes;
    collect(json, nodes);
    Json& node = *nodes[anyIn(random, nodes.size())];
    const Json other = *nodes[anyIn(random, nodes.size())];
    switch (random.below(10)) {
      case 0:
        node = other;
        break;
      case 1:
        if (node.is_structured() && !node.empty()) {
          auto child = node.begin();
          std::advance(child, static_cast<std::ptrdiff_t>(random.below(node.size())));
          node.erase(child);
        }
        break;
      case 2:
        if (node.is_array() && !node.empty() && node.size() < 1000)
          node.insert(node.end(), node[anyIn(random, node.size())]);
        else if (node.is_string())
          changeBytes(node.get_ref<std::string&>(), random);
        break;
      case 3:
        if (node.is_number_integer())
          node = node.get<std::int64_t>() / 2 + static_cast<std::int64_t>(random.below(5)) - 2;
        else if (node.is_number_float())
          node = -10.0 * node.get<double>();
        break;
      case 4:
        if (random.below(20) == 0) node = nested;
        break;
      default:
        node = oddJson(random);
    }
  }
  std::string written = json.dump(-1, ' ', false, Json::error_handler_t::replace);
  const std::string mark = std::string("\"") + nested + '"';
  if (const std::size_t at = written.find(mark); at != std::string::npos) {
    const std::size_t depth = std::size_t{1} << random.below(16);
    const bool lists = random.below(2) == 0;
    std::string deep;
    for (std::size_t i = 0; i < depth; ++i) deep += lists ? "[" : "{\"a\":";
    deep += "0";
    for (std::size_t i = 0; i < depth; ++i) deep += lists ? "]" : "}";
    written.replace(at, mark.size(), deep);
  }
  return written;
}

}  // namespace relucent::fuzz
