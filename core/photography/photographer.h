// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "relucent/linearization/linearization.h"
#include "relucent/photography/bracket.h"

namespace relucent::photography {

/// What one camera pixel needs of a photograph.
struct Demand {
  float brightest = -1.0f;  // radiance that it may reach; below zero: the pixel is not needed
  float expected = 0.0f;    // radiance that it will rather have
  float deviation = 0.0f;   // standard deviation of its radiance that is good enough
};

/// Work that needs no device and goes on while a photograph is exposed; empty: none.
using Meanwhile = std::function<void()>;

/// Chooses for each pattern the fewest exposures that do justice to the pixels that are needed, and takes
/// what came out saturated again with shorter ones.
class Photographer {
 public:
  /// Keeps references: both outlive it.
  Photographer(rig::ShotTaker& shots, const linearization::Linearization& linearization);

  rig::ShotTaker& shots() { return shots_; }
  const Rasters& cameras() const { return cameras_; }
  const Rasters& projectors() const { return projectors_; }

  /// Merged radiance under linear binary patterns (a projector stack of zeros and ones: full drive needs no
  /// projector curve). Demands: one per camera pixel. Pixels with a demand that stay invalid are saturated
  /// at the shortest exposure. `meanwhile` is done, besides, when this returns.
  hdr::HdrFrame take(const ProjectorStack& pattern, const std::vector<Demand>& demands,
                     const Progress& progress, const Meanwhile& meanwhile = {});
  /// With every exposure there is.
  hdr::HdrFrame takeAll(const ProjectorStack& pattern, const Progress& progress,
                        const Meanwhile& meanwhile = {});

  /// With these exposures, longest first, and no others: what they saturate comes out invalid.
  hdr::HdrFrame takeAt(const ProjectorStack& pattern, const std::vector<std::size_t>& exposures,
                       const Progress& progress, const Meanwhile& meanwhile = {});

  /// Exposures that there are.
  std::size_t exposures() const { return linearization_.exposures.size(); }

  /// How much the exposures of the last photograph contradict each other, see bracket.h.
  double contradiction() const { return contradiction_; }
  /// Those that do, where it is worth a look (worthALook, relative).
  static constexpr double worthALook = 0.02;
  const std::optional<ContradictoryViews>& contradictoryViews() const { return contradictory_; }

  /// How often the last photograph was taken again because some pixel that is needed was overexposed.
  int overexposed() const { return overexposed_; }

  /// Standard deviation of one camera pixel's radiance at an exposure of the list.
  double deviation(std::size_t row, double radiance, std::size_t exposure) const;

  /// Indices into Linearization::exposures, longest first: the fewest with one for every demanded pixel
  /// that does not saturate it, and for nearly all of them one that is not too noisy either.
  std::vector<std::size_t> exposuresFor(const std::vector<Demand>& demands) const;

  /// Index of the longest exposure that a radiance does not come near to saturating, or of the shortest.
  std::size_t longestUnsaturated(std::size_t row, double radiance) const;

 private:
  rig::Shot shoot(const std::vector<image::Image>& encoded, const std::vector<std::size_t>& exposures,
                  const Progress& progress, const Meanwhile& meanwhile);
  bool needsShorter(const hdr::HdrFrame& frame, const std::vector<Demand>& demands) const;
  void compareExposures(const rig::Shot& shot);

  rig::ShotTaker& shots_;
  const linearization::Linearization& linearization_;
  Rasters cameras_;
  Rasters projectors_;
  std::vector<std::uint8_t> cameraOf_;  // per row
  double contradiction_ = 0.0;
  std::optional<ContradictoryViews> contradictory_;
  int overexposed_ = 0;
  std::vector<double> saturation_;  // per camera: linear signal that no channel should reach
};

}  // namespace relucent::photography
