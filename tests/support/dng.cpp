// SPDX-License-Identifier: MIT
#include "support/dng.h"

#include <algorithm>
#include <cmath>

namespace relucent::test {
namespace {

constexpr unsigned byteType = 1, textType = 2, shortType = 3, longType = 4, ratioType = 5,
                   signedRatioType = 10;

void append(std::string& bytes, std::uint32_t value, int count) {
  for (int i = 0; i < count; ++i) bytes += static_cast<char>(value >> (8 * i) & 0xffu);
}

std::string shorts(const std::vector<std::uint32_t>& values) {
  std::string bytes;
  for (std::uint32_t value : values) append(bytes, value, 2);
  return bytes;
}

std::string longs(const std::vector<std::uint32_t>& values) {
  std::string bytes;
  for (std::uint32_t value : values) append(bytes, value, 4);
  return bytes;
}

/// A directory of a TIFF file. Tags have to be added in ascending order.
class Directory {
 public:
  void add(unsigned tag, unsigned type, std::string value) {
    const std::size_t each = type == byteType || type == textType ? 1
                             : type == shortType                  ? 2
                             : type == longType                   ? 4
                                                                  : 8;
    entries_.push_back({tag, type, value.size() / each, std::move(value)});
  }
  std::size_t bytes() const {
    std::size_t sum = 2 + 12 * entries_.size() + 4;
    for (const Entry& entry : entries_)
      if (entry.value.size() > 4) sum += entry.value.size() + entry.value.size() % 2;
    return sum;
  }
  /// As it stands at `offset` in the file; what does not fit into the entries follows them.
  std::string at(std::size_t offset) const {
    std::string head, tail;
    append(head, static_cast<std::uint32_t>(entries_.size()), 2);
    const std::size_t begin = offset + 2 + 12 * entries_.size() + 4;
    for (const Entry& entry : entries_) {
      append(head, entry.tag, 2);
      append(head, entry.type, 2);
      append(head, static_cast<std::uint32_t>(entry.count), 4);
      std::string value = entry.value;
      if (value.size() > 4) {
        append(head, static_cast<std::uint32_t>(begin + tail.size()), 4);
        value.resize(value.size() + value.size() % 2);
        tail += value;
      } else {
        value.resize(4);
        head += value;
      }
    }
    append(head, 0, 4);
    return head + tail;
  }

 private:
  struct Entry {
    unsigned tag, type;
    std::size_t count;
    std::string value;
  };
  std::vector<Entry> entries_;
};

Directory exifOf(const Dng& dng) {
  Directory exif;
  if (dng.seconds > 0.0)
    exif.add(33434, ratioType,
             longs({static_cast<std::uint32_t>(std::lround(dng.seconds * 1e6)), 1'000'000}));
  if (!dng.taken.empty()) exif.add(36867, textType, dng.taken + '\0');
  return exif;
}

/// With the places of what lies behind it, which do not change its length.
Directory directoryOf(const Dng& dng, std::size_t exif, std::size_t samples) {
  const auto count = static_cast<std::uint32_t>(dng.codes.size());
  const std::uint32_t each = dng.isLinear ? 3 : 1;
  Directory tags;
  tags.add(254, longType, longs({0}));
  tags.add(256, longType, longs({static_cast<std::uint32_t>(dng.size.width)}));
  tags.add(257, longType, longs({static_cast<std::uint32_t>(dng.size.height)}));
  tags.add(258, shortType, shorts(std::vector<std::uint32_t>(each, 16)));
  tags.add(259, shortType, shorts({1}));
  tags.add(262, shortType, shorts({dng.isLinear ? 34892u : 32803u}));
  tags.add(271, textType, std::string("Relucent\0", 9));
  tags.add(272, textType, std::string("Test\0", 5));
  tags.add(273, longType, longs({static_cast<std::uint32_t>(samples)}));
  tags.add(277, shortType, shorts({each}));
  tags.add(278, longType, longs({static_cast<std::uint32_t>(dng.size.height)}));
  tags.add(279, longType, longs({2 * count}));
  tags.add(284, shortType, shorts({1}));
  if (!dng.isLinear) {
    tags.add(33421, shortType, shorts({2, 2}));
    tags.add(33422, byteType, {dng.filter.begin(), dng.filter.end()});
  }
  tags.add(34665, longType, longs({static_cast<std::uint32_t>(exif)}));
  tags.add(50706, byteType, std::string("\1\4\0\0", 4));
  tags.add(50708, textType, std::string("Relucent Test\0", 14));
  if (!dng.isLinear) {
    tags.add(50713, shortType, shorts({2, 2}));
    tags.add(50714, shortType, shorts({dng.black.begin(), dng.black.end()}));
  }
  tags.add(50717, shortType, shorts(std::vector<std::uint32_t>(each, dng.white)));
  tags.add(50721, signedRatioType, longs({1, 1, 0, 1, 0, 1, 0, 1, 1, 1, 0, 1, 0, 1, 0, 1, 1, 1}));
  tags.add(50728, ratioType, longs({1, 2, 1, 1, 2, 3}));  // a white balance that must not be applied
  return tags;
}

}  // namespace

std::string bytesOf(const Dng& dng) {
  constexpr std::size_t header = 8;
  const std::size_t exifAt = header + directoryOf(dng, 0, 0).bytes();
  const std::size_t samplesAt = exifAt + exifOf(dng).bytes();
  std::string bytes("II*\0", 4);
  append(bytes, header, 4);
  bytes += directoryOf(dng, exifAt, samplesAt).at(header);
  bytes += exifOf(dng).at(exifAt);
  for (std::uint16_t code : dng.codes) append(bytes, code, 2);
  return bytes;
}

Dng dngOf(const image::Image& signal) {
  constexpr float black = 512.0f, white = 15871.0f;
  Dng dng;
  dng.size = {2 * signal.width(), 2 * signal.height()};
  dng.black.fill(static_cast<std::uint16_t>(black));
  dng.white = static_cast<std::uint16_t>(white);
  for (int y = 0; y < dng.size.height; ++y)
    for (int x = 0; x < dng.size.width; ++x) {
      const float value = signal.at(x / 2, y / 2, y % 2 + x % 2);
      const float code = std::round(black + (white - black) * value);
      dng.codes.push_back(static_cast<std::uint16_t>(std::clamp(code, 0.0f, 16383.0f)));
    }
  return dng;
}

}  // namespace relucent::test
