// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "relucent/base/progress.h"
#include "relucent/linearization/mosaic.h"

namespace relucent::linearization {

/// What a mosaic's lights show: 0 dark, k the projector's k-th drive; the last is full.
using MosaicLevels = std::array<std::size_t, mosaicLights>;

/// What a photograph of all projectors' mosaics shows.
struct MosaicShot {
  std::vector<MosaicLevels> level;  // per projector
  double time = 0.0;                // when, counted in shots: for the drift of the lamps
};

/// Weighted products of the photographs' light: all that the fit needs to know of the pixels.
///   at(m, n) = sum_i w_i L_im L_in,   noise(m) = sum_i w_i variance_im,   i values of camera pixels
class LightProducts {
 public:
  explicit LightProducts(std::size_t shots = 0) : products_(shots * shots, 0.0), noise_(shots, 0.0) {}

  /// One value's light in every photograph, less black, and its variances.
  void add(std::span<const double> light, std::span<const double> variance, double weight);
  LightProducts& operator+=(const LightProducts& other);

  std::size_t shots() const { return noise_.size(); }
  double at(std::size_t m, std::size_t n) const { return products_[m * noise_.size() + n]; }
  double noise(std::size_t m) const { return noise_[m]; }
  double values() const { return values_; }

 private:
  std::vector<double> products_, noise_;
  double values_ = 0.0;
};

/// Light of every drive but 0 relative to full drive, per channel; the last is 1.
using LevelLights = std::array<std::vector<double>, 3>;

/// As displays usually respond, drive^2.2: where a search begins that knows nothing better. Per projector.
std::vector<LevelLights> usualResponses(const std::vector<std::vector<double>>& drives);

/// Of one projector.
struct ResponseFit {
  LevelLights light;
  LevelLights deviation;  // standard deviations
  /// How much more light the photographs alone have at a level, everything else as it was fitted: what is
  /// left of chi^2 by the level, one step of Newton's. 0 where no photograph says.
  LevelLights residual;
  std::vector<double>
      power;             // of the lamp in every photograph, relative to a straight line's start; 1 where dark
  double flicker = 0.0;  // relative standard deviation of that power about the line
  double drift = 0.0;    // relative change of power per shot: the line
  double whiteSegment = 0.0;  // light added where all channels are lit: this times their smallest
};

/// The response that each projector's whole picture has in common, from photographs of mosaics, which may
/// overlap. Light is linear, so each photograph, at every camera value i, is a sum of nine lights a
/// projector:
///   L_im = sum_p power_pm sum_q a_ipq f_p,channel(q)(drive_pqm) + noise
/// whatever of it is direct, scattered or blurred. The lights a_i are eliminated (variable projection); what
/// is left to minimise depends on products of photographs only:
///   chi^2 = trace(C (I - X^+ X)),  C = LightProducts over the noise,
///   X_pq,m = power_pm (f_p(drive_pqm) + w_p min over the group's channels of f_p)
/// over f, the powers (each lamp's about a straight line in time, as far off as the photographs say they are)
/// and the lights w of white segments. Fourth differences of f are 7e-4 a priori, with the tails of a Cauchy
/// distribution: what is smooth becomes smoother, kinks and steps remain.
/// Per projector `drives`, which ascend and end with 1, and `start`, where the search begins.
/// Source: core/linearization/README.md, [GOL], [KAU].
/// Throws: Error{numerics} if the lights cannot be told apart; Cancelled, which is looked for at every step.
std::vector<ResponseFit> fitResponses(const std::vector<std::vector<double>>& drives,
                                      const std::vector<MosaicShot>& shots, const LightProducts& products,
                                      const std::vector<LevelLights>& start, Progress& progress);

/// How far one region's response is from a projector's fit, the whole picture's: for every channel the
/// amplitude of
///   f -> f - amplitude e f ln f,
/// which is what another exponent does, at most `amplitude` of white; and its standard deviation.
struct RegionDeviation {
  std::array<double, 3> amplitude{}, deviation{};
};
/// Per projector.
std::vector<RegionDeviation> deviationsOf(const std::vector<ResponseFit>& fits,
                                          const std::vector<MosaicShot>& shots, const LightProducts& region);

}  // namespace relucent::linearization
