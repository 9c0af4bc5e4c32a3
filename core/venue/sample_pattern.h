// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace relucent::venue {

/// `count` points that cover the unit square evenly, for each of several independent pairs of dimensions.
/// Source: Kollig & Keller, "Efficient multidimensional sampling", 2002: Sobol's (0, 2)-sequence, randomly
/// scrambled per pair, in a random order per pair so that pairs do not correlate.
class SamplePattern {
 public:
  static constexpr int pairs = 32;

  SamplePattern(int count, std::uint64_t seed);

  int count() const { return count_; }
  /// Point `index` of a pair, shifted by `shift` with wrap-around in the unit square; pairs repeat after the
  /// last.
  Eigen::Vector2f point(int index, int pair, const Eigen::Vector2f& shift) const {
    const Eigen::Vector2f& stored = points_[static_cast<std::size_t>((pair % pairs) * count_ + index)];
    return {wrapped(stored.x() + shift.x()), wrapped(stored.y() + shift.y())};
  }

 private:
  static float wrapped(float x) { return x < 1.0f ? x : x - 1.0f; }
  int count_;
  std::vector<Eigen::Vector2f> points_;
};

}  // namespace relucent::venue
