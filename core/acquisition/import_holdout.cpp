// SPDX-License-Identifier: MIT
#include <algorithm>

#include "acquisition/import.h"
#include "acquisition/import_data.h"
#include "base/random.h"

namespace relucent {
namespace {

/// How far apart places are that some patterns cannot tell from each other: mean, over all projector pixels,
/// of the width and height of the box around all pixels with the same sequence.
double ambiguityOf(const PictureSequence& patterns, const std::vector<int>& frames) {
  Size size = patterns.size();
  std::vector<std::pair<std::uint64_t, std::uint32_t>> places(size.count());
  parallelFor(0, size.count(), 1024, [&](std::size_t pixel) {
    std::uint64_t key = 0;
    for (int frame : frames)
      for (int c = 0; c < (patterns.isColoured() ? 3 : 1); ++c)
        key = Random{key, patterns.code(pixel, frame, c)}.next();
    places[pixel] = {key, static_cast<std::uint32_t>(pixel)};
  });
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

std::vector<int> without(const std::vector<int>& all, const std::vector<int>& some, int one) {
  std::vector<int> rest;
  for (int k : all)
    if (k != one && std::find(some.begin(), some.end(), k) == some.end()) rest.push_back(k);
  return rest;
}

}  // namespace

std::vector<int> heldOutPatterns(const PictureSequence& patterns, int every) {
  std::vector<int> order = byFineness(patterns);
  auto group = static_cast<std::size_t>(every);
  // Two neighbours may be confused, on small projectors and large ones alike in relation.
  double allowed = 1.05 * ambiguityOf(patterns, order) +
                   std::max(2.0, std::max(patterns.size().width, patterns.size().height) / 256.0);
  std::vector<int> held;
  for (std::size_t begin = 0; begin + group / 2 < order.size(); begin += group) {
    std::size_t end = std::min(order.size(), begin + group);
    for (std::size_t k = 0; k < end - begin; ++k) {
      int candidate = order[begin + (group / 2 + k) % (end - begin)];
      if (ambiguityOf(patterns, without(order, held, candidate)) > allowed) continue;
      held.push_back(candidate);
      break;
    }
  }
  if (held.empty() && order.size() > 1) held.push_back(order.back());
  std::sort(held.begin(), held.end());
  return held;
}

}  // namespace relucent
