// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <numbers>

namespace relucent {

/// Seeded random numbers that are the same on every platform and for every number of threads.
/// A generator is made from a list of keys (seed, shot, row, ...): parallel work uses one generator per item,
/// so that the order of execution does not matter.
/// Source: SplitMix64, Steele, Lea & Flood, "Fast splittable pseudorandom number generators", 2014.
class Random {
 public:
  explicit Random(std::initializer_list<std::uint64_t> keys) {
    for (std::uint64_t key : keys) state_ = mix(state_ + 0x9e3779b97f4a7c15ULL + key);
  }

  std::uint64_t next() { return mix(state_ += 0x9e3779b97f4a7c15ULL); }

  /// Uniform in [0, 1).
  double uniform() { return static_cast<double>(next() >> 11) * 0x1.0p-53; }
  float uniformFloat() { return static_cast<float>(next() >> 40) * 0x1.0p-24f; }
  /// Uniform in {0, ..., n-1}, 0 < n <= 2^53.
  std::uint64_t below(std::uint64_t n) {
    return static_cast<std::uint64_t>(uniform() * static_cast<double>(n));
  }
  /// Standard normal (Box-Muller; the second value is kept for the next call).
  double normal() {
    if (hasSpare_) {
      hasSpare_ = false;
      return spare_;
    }
    double radius = std::sqrt(-2.0 * std::log(1.0 - uniform()));
    double angle = 2.0 * std::numbers::pi * uniform();
    spare_ = radius * std::sin(angle);
    hasSpare_ = true;
    return radius * std::cos(angle);
  }

 private:
  static std::uint64_t mix(std::uint64_t z) {
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    return z ^ (z >> 31);
  }

  std::uint64_t state_ = 0;
  double spare_ = 0.0;
  bool hasSpare_ = false;
};

}  // namespace relucent
