// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "relucent/monitoring/shadow_map.h"
#include "relucent/monitoring/synchronisation.h"

namespace relucent::monitoring {

/// Which cells' light is held back: 1 per cell of a ShadowMap, 0 where it arrives.
using BlockedCells = std::vector<std::uint8_t>;

/// What else is known of a photograph's light, as fitLight() finds it.
struct KnownLight {
  std::vector<double> gains;                   // of the projectors' channels, three a projector
  std::vector<double> room{0, 0, 0, 0, 0, 0};  // of e; then of the flood image
};

/// How well a photograph y agrees with cells whose light is held back:
///   predicted = e + room + sum_j (T p)_j (1 - sum of the blocked cells' shares in j's light)
///   misfit of a sample = 8 log(1 + chi^2 / 8),  chi^2 = sum_c (y - predicted)^2 / s^2
/// so that whoever stands before the camera counts for little, and yet what comes nearer to y counts.
class ShadowEvidence {
 public:
  ShadowEvidence(const Observed& seen, const Moment& moment, const WatchedVenue& venue, const ShadowMap& map,
                 const KnownLight& known);

  void assume(const BlockedCells& blocked);
  const BlockedCells& blocked() const { return blocked_; }
  void set(std::size_t cell, bool blocked);
  /// Change of all samples' misfit by turning one cell over.
  double changeBy(std::size_t cell) const;
  /// chi^2 that would be between a cell that is blocked and one that is not: how much the photograph tells of
  /// it.
  double informationOf(std::size_t cell) const { return information_[cell]; }
  /// The share of a cell's light that arrives, by least squares, if all others are as assumed.
  double shareOf(std::size_t cell) const;
  /// Of all samples.
  double misfit() const { return total_; }
  /// The part of what some cells light that is as predicted.
  double explainedOf(std::span<const std::size_t> cells) const;
  /// Likewise of all samples, by their light.
  double explained() const;

 private:
  struct Sample {
    std::array<float, 3> left{}, precision{};  // y - e - room; 1 / s^2, 0 where it is saturated
  };
  double misfitAt(std::size_t sample, std::size_t projector, float more) const;
  double squaredAt(std::size_t sample, std::size_t projector, float more) const;
  const std::array<float, 3>& lightOf(std::size_t sample, std::size_t projector) const {
    return light_[sample * map_.projectors() + projector];
  }
  float missing(std::size_t sample, std::size_t projector) const {
    return missing_[sample * map_.projectors() + projector];
  }
  void findMisfit(std::size_t sample);

  const ShadowMap& map_;
  std::vector<Sample> samples_;
  std::vector<std::array<float, 3>> light_;  // per sample and projector: T p
  std::vector<float> missing_;               // likewise: the share that is held back
  std::vector<double> misfit_, information_;
  double total_ = 0.0;
  BlockedCells blocked_;
};

}  // namespace relucent::monitoring
