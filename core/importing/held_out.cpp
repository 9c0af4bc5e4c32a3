// SPDX-License-Identifier: MIT
#include "relucent/importing/held_out.h"

#include <algorithm>
#include <cmath>

#include "relucent/base/random.h"
#include "relucent/importing/sequences.h"

namespace relucent::importing {
namespace {

/// Patterns that say the same: equal ones and negatives of each other.
using Family = std::vector<int>;

/// What a pattern says of a projector pixel: sums of it over patterns are equal where all of them say the
/// same.
std::uint64_t keyOf(const PictureSequence& patterns, int frame, std::size_t pixel) {
  const auto number = static_cast<std::uint64_t>(frame);
  if (!patterns.isColoured()) return Random{number, patterns.code(pixel, frame, 0)}.next();
  return Random{number, patterns.code(pixel, frame, 0), patterns.code(pixel, frame, 1),
                patterns.code(pixel, frame, 2)}
      .next();
}

/// Which projector pixels some patterns tell apart.
class ToldApart {
 public:
  ToldApart(const PictureSequence& patterns, const std::vector<int>& frames)
      : patterns_(patterns), key_(patterns.size().count(), 0) {
    parallelFor(0, key_.size(), 1024, [&](std::size_t pixel) {
      for (int frame : frames) key_[pixel] += keyOf(patterns_, frame, pixel);
    });
  }

  void leaveOut(const Family& family) { key_ = keysWithout(family); }

  /// How far apart places are that the patterns without a family cannot tell from each other: mean, over all
  /// projector pixels, of the width and height of the box around all pixels with the same sequence.
  double ambiguityWithout(const Family& family) const {
    const Size size = patterns_.size();
    const std::vector<std::uint64_t> key = keysWithout(family);
    std::vector<std::pair<std::uint64_t, std::uint32_t>> places(key.size());
    for (std::size_t pixel = 0; pixel < key.size(); ++pixel)
      places[pixel] = {key[pixel], static_cast<std::uint32_t>(pixel)};
    std::sort(places.begin(), places.end());
    double sum = 0.0;
    for (std::size_t begin = 0, end = 0; begin < places.size(); begin = end) {
      Pixel least = pixelAt(size, places[begin].second), most = least;
      for (end = begin; end < places.size() && places[end].first == places[begin].first; ++end) {
        Pixel at = pixelAt(size, places[end].second);
        least = {std::min(least.x, at.x), std::min(least.y, at.y)};
        most = {std::max(most.x, at.x), std::max(most.y, at.y)};
      }
      sum += static_cast<double>(end - begin) * (most.x - least.x + most.y - least.y);
    }
    return sum / static_cast<double>(size.count());
  }

 private:
  std::vector<std::uint64_t> keysWithout(const Family& family) const {
    std::vector<std::uint64_t> key = key_;
    parallelFor(0, key.size(), 1024, [&](std::size_t pixel) {
      for (int frame : family) key[pixel] -= keyOf(patterns_, frame, pixel);
    });
    return key;
  }

  const PictureSequence& patterns_;
  std::vector<std::uint64_t> key_;  // of all that are not left out
};

/// Equal, or one the negative of the other, but for what a file format that loses something does to both.
bool saySame(const PictureSequence& patterns, int a, int b) {
  constexpr double full = 65535.0, most = 0.1;
  std::size_t pixels = patterns.size().count();
  int channels = patterns.isColoured() ? 3 : 1;
  double sum = 0.0, count = static_cast<double>(pixels) * channels;
  for (std::size_t pixel = 0; pixel < pixels; ++pixel)
    for (int c = 0; c < channels; ++c) sum += patterns.code(pixel, a, c);
  double mean = sum / count, varies = 0.0, equal = 0.0, negative = 0.0;
  for (std::size_t pixel = 0; pixel < pixels; ++pixel)
    for (int c = 0; c < channels; ++c) {
      double x = patterns.code(pixel, a, c), y = patterns.code(pixel, b, c);
      varies += std::abs(x - mean);
      equal += std::abs(x - y);
      negative += std::abs(x + y - full);
    }
  return std::min(equal, negative) < most * varies;
}

/// `order`: ascending in fineness, which is the same for patterns that say the same.
std::vector<Family> familiesOf(const PictureSequence& patterns, const std::vector<int>& order) {
  constexpr double finer = 1.1;
  std::vector<double> fineness;
  for (int k : order) fineness.push_back(finenessOf(patterns, k));
  std::vector<Family> families;
  std::vector<std::uint8_t> taken(order.size(), 0);
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (taken[i] != 0) continue;
    Family family{order[i]};
    for (std::size_t k = i + 1; k < order.size() && fineness[k] <= finer * fineness[i]; ++k) {
      if (taken[k] != 0 || !saySame(patterns, order[i], order[k])) continue;
      taken[k] = 1;
      family.push_back(order[k]);
    }
    families.push_back(std::move(family));
  }
  return families;
}

}  // namespace

std::vector<int> heldOutPatterns(const PictureSequence& patterns, int every) {
  std::vector<int> order = byFineness(patterns);
  std::vector<Family> families = familiesOf(patterns, order);
  auto group = static_cast<std::size_t>(every);
  // Neighbours may be confused, two across and then two down: the finest stripes, which camera pixels settle
  // together. Without coarser ones, places far apart would look alike.
  ToldApart told(patterns, order);
  double before = 1.05 * told.ambiguityWithout({}), oneAxis = before + 1.0, bothAxes = before + 2.0;
  std::vector<int> held;
  auto spare = [&](Family& family, double allowed) {
    if (family.empty() || told.ambiguityWithout(family) > allowed) return false;
    told.leaveOut(family);
    held.insert(held.end(), family.begin(), family.end());
    family.clear();
    return true;
  };
  std::size_t missing = 0;
  for (std::size_t begin = 0; begin + group / 2 < families.size(); begin += group) {
    std::size_t end = std::min(families.size(), begin + group), k = 0;
    while (k < end - begin && !spare(families[begin + (group / 2 + k) % (end - begin)], oneAxis)) ++k;
    missing += k == end - begin ? 1 : 0;
  }
  // What no group can spare, finer patterns have to make up for.
  for (std::size_t i = families.size(); i-- > 0 && missing > 0;)
    if (spare(families[i], bothAxes)) --missing;
  if (held.empty() && families.size() > 1) held = families.back();
  std::sort(held.begin(), held.end());
  return held;
}

}  // namespace relucent::importing
