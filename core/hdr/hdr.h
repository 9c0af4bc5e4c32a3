// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "relucent/base/raster.h"
#include "relucent/hdr/response_curve.h"
#include "relucent/rig/shot.h"

namespace relucent::hdr {

/// True value of an exposure time that a camera reports: true seconds = scale * reported.
struct ExposureTime {
  double reported = 0.0;
  double scale = 1.0;
  bool operator==(const ExposureTime&) const = default;
};

/// Signals are good to this share of where they clip.
inline constexpr double saturationMargin = 0.97;

/// How a camera's signal depends on light, and how noisy it is.
///   linear = response(signal), radiance = linear / trueSeconds
///   variance of the linear signal = readNoise^2 + gain * linear + (response'(signal)^2 - 1) q^2,
/// in units of full scale; q^2 = 1 / (12 (2^bits - 1)^2) is the variance of rounding, which a response
/// curve stretches; without a curve the last term is zero.
struct CameraModel {
  std::array<ResponseCurve, 3> response;  // identity for linear sensors
  double readNoise = 2e-3;                // standard deviation at black, rounding included
  double gain = 1e-4;                     // photon noise: variance per linear signal
  double saturation = saturationMargin;   // signals at or above this are only a lower bound
  std::vector<ExposureTime> times;  // measured, reported times ascending; empty: reported times are used
};

/// The true exposure time: exact at the measured ones, scale interpolated over log time between them,
/// that of the nearest beyond them.
double trueSeconds(const CameraModel& camera, double reported);

/// Variance of the linear signal, without the effect of a response curve on rounding.
inline double linearVariance(const CameraModel& camera, double linear) {
  return camera.readNoise * camera.readNoise + camera.gain * (linear > 0.0 ? linear : 0.0);
}

/// A merged bracket: linear radiance (camera signal per true second) with its variance.
struct HdrFrame {
  CameraStack radiance;
  CameraStack variance;
  std::vector<std::uint8_t> valid;  // per value; 0 where every exposure was saturated
};

// Three quantities of the same shape that must not be taken for one another: each is made from the one
// before.

/// e: the radiance under black projectors, which is the room's light and what the projectors leak.
struct BlackLevel : HdrFrame {
  BlackLevel() = default;
  explicit BlackLevel(HdrFrame frame) : HdrFrame(std::move(frame)) {}
};

/// Radiance less e: what the projectors add, with a lamp as strong as it was just then.
struct ProjectedLight : HdrFrame {
  ProjectedLight() = default;
  ProjectedLight(HdrFrame frame, const BlackLevel& black);
};

/// Projected light over the lamp's power: T p, whenever it was photographed. sentinels::Watch knows that
/// power.
struct LampLight : HdrFrame {
  LampLight() = default;
  /// `power` of the lamp relative to when T's first photograph was taken.
  LampLight(ProjectedLight light, double power);
};

/// Inverse-variance weighted mean of the unsaturated exposures,
///   L = sum_k w_k z_k / t_k / sum_k w_k,   w_k = s_k t_k^2 / var(z_k).
/// z_k in the variance is predicted from the current L, so that the weights do not follow the noise. For the
/// same reason the weight s_k falls linearly from 1 at 0.7 of saturation to 0 at saturation: with a sharp
/// limit only the darker half of a noisy signal would count.
/// t_k = trueSeconds(camera, time that the frame reports), z_k = response(signal).
/// Where every exposure is saturated: valid = 0, radiance = the lower bound given by the shortest, variance =
/// its square.
/// Shapes: all cameras' pixels, see Rasters.  Source: core/hdr/README.md, [GRA], [AGU].
HdrFrame mergeBracket(const rig::Shot& shot, const std::vector<CameraModel>& cameras, const Rasters& rasters);

/// The mean of several frames of the same light; variances of the mean. Only valid values count; where none
/// is valid, the result is the largest lower bound.
HdrFrame meanOf(const std::vector<HdrFrame>& frames);

/// True times of a shot's exposures relative to the first one's, from the same light:
/// between neighbours in time the median, over pixels well exposed in the longer and not dark in the
/// shorter, of their signals' ratio, then the ratio of sums over what lies close to it.
/// Where fewer than 50 values can be compared, the reported times are used.
/// Shapes: one ratio for each exposure.  Law: invariant under scaling of all light.
std::vector<double> exposureRatios(const rig::Shot& shot, std::size_t camera, const CameraModel& model);

}  // namespace relucent::hdr
