// SPDX-License-Identifier: MIT
#include "relucent/venue/sample_pattern.h"

#include <numeric>
#include <utility>

#include "relucent/base/error.h"
#include "relucent/base/random.h"

namespace relucent::venue {
namespace {

std::uint32_t radicalInverse(std::uint32_t n) {
  std::uint32_t result = 0;
  for (std::uint32_t bit = 0x80000000u; n != 0; n >>= 1, bit >>= 1)
    if (n & 1u) result |= bit;
  return result;
}

std::uint32_t secondSobol(std::uint32_t n) {
  std::uint32_t result = 0;
  for (std::uint32_t direction = 0x80000000u; n != 0; n >>= 1, direction ^= direction >> 1)
    if (n & 1u) result ^= direction;
  return result;
}

float toUnit(std::uint32_t bits) {
  return static_cast<float>(bits >> 8) * 0x1.0p-24f;
}

}  // namespace

SamplePattern::SamplePattern(int count, std::uint64_t seed) : count_(count) {
  require(count > 0, "a pattern of {} samples", count);
  points_.resize(static_cast<std::size_t>(count * pairs));
  std::vector<std::uint32_t> order(static_cast<std::size_t>(count));
  for (int pair = 0; pair < pairs; ++pair) {
    Random random({seed, static_cast<std::uint64_t>(pair)});
    std::iota(order.begin(), order.end(), 0u);
    for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random.below(i)]);
    std::uint32_t scrambleX = static_cast<std::uint32_t>(random.next());
    std::uint32_t scrambleY = static_cast<std::uint32_t>(random.next());
    for (std::size_t i = 0; i < order.size(); ++i)
      points_[static_cast<std::size_t>(pair * count) + i] = {toUnit(radicalInverse(order[i]) ^ scrambleX),
                                                             toUnit(secondSobol(order[i]) ^ scrambleY)};
  }
}

}  // namespace relucent::venue
