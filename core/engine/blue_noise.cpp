// SPDX-License-Identifier: MIT
#include "relucent/engine/blue_noise.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "relucent/base/error.h"
#include "relucent/base/random.h"

namespace relucent::engine {
namespace {

/// Dots on a torus, and how crowded each place is.
class Dots {
 public:
  explicit Dots(int side) : side_(static_cast<std::size_t>(side)), kernel_(side_ * side_) {
    auto wrapped = [&](std::size_t i) { return static_cast<double>(std::min(i, side_ - i)); };
    constexpr double sigma = 1.5;
    for (std::size_t y = 0; y < side_; ++y)
      for (std::size_t x = 0; x < side_; ++x)
        kernel_[y * side_ + x] =
            std::exp(-(wrapped(x) * wrapped(x) + wrapped(y) * wrapped(y)) / (2 * sigma * sigma));
    set_.assign(kernel_.size(), 0);
    crowding_.assign(kernel_.size(), 0.0);
  }

  bool isSet(std::size_t place) const { return set_[place] != 0; }
  void put(std::size_t place) { change(place, 1.0); }
  void take(std::size_t place) { change(place, -1.0); }
  /// The dot that is most crowded, or the gap that is least.
  std::size_t tightestCluster() const {
    return extreme(1, [](double a, double b) { return a > b; });
  }
  std::size_t largestVoid() const {
    return extreme(0, [](double a, double b) { return a < b; });
  }

 private:
  void change(std::size_t place, double sign) {
    set_[place] = sign > 0.0;
    std::size_t px = place % side_, py = place / side_;
    for (std::size_t y = 0; y < side_; ++y)
      for (std::size_t x = 0; x < side_; ++x)
        crowding_[y * side_ + x] +=
            sign * kernel_[(y + side_ - py) % side_ * side_ + (x + side_ - px) % side_];
  }
  template <typename Better>
  std::size_t extreme(std::uint8_t which, const Better& better) const {
    std::size_t best = set_.size();
    for (std::size_t i = 0; i < set_.size(); ++i)
      if (set_[i] == which && (best == set_.size() || better(crowding_[i], crowding_[best]))) best = i;
    return best;
  }

  std::size_t side_;
  std::vector<double> kernel_, crowding_;
  std::vector<std::uint8_t> set_;
};

}  // namespace

std::vector<float> blueNoise(int side) {
  require(side >= 4 && side <= 256, "blue noise of {0}x{0}", side);
  Dots dots(side);
  auto places = static_cast<std::size_t>(side) * static_cast<std::size_t>(side);
  // A tenth of the places, moved about until no dot has a better place to go.
  Random random{1993};
  std::size_t first = 0;
  while (first < places / 10) {
    std::size_t place = random.below(places);
    if (dots.isSet(place)) continue;
    dots.put(place);
    ++first;
  }
  for (std::size_t move = 0; move < places; ++move) {
    std::size_t from = dots.tightestCluster();
    dots.take(from);
    std::size_t to = dots.largestVoid();
    dots.put(to);
    if (to == from) break;
  }

  std::vector<float> threshold(places);
  auto rank = [&](std::size_t place, std::size_t number) {
    threshold[place] = (static_cast<float>(number) + 0.5f) / static_cast<float>(places);
  };
  Dots left = dots;
  for (std::size_t number = first; number-- > 0;) {
    std::size_t place = left.tightestCluster();
    left.take(place);
    rank(place, number);
  }
  for (std::size_t number = first; number < places; ++number) {
    std::size_t place = dots.largestVoid();
    dots.put(place);
    rank(place, number);
  }
  return threshold;
}

}  // namespace relucent::engine
