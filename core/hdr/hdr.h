// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/raster.h"
#include "hdr/response_curve.h"
#include "rig/shot.h"

namespace relucent {

/// How a camera's signal depends on light, and how noisy it is.
///   linear = response(signal), radiance = linear / seconds
///   variance of the linear signal = readNoise^2 + gain * linear   (both in units of full scale)
struct CameraModel {
  std::array<ResponseCurve, 3> response;  // identity for linear sensors
  double readNoise = 2e-3;                // standard deviation at black, quantisation included
  double gain = 1e-4;                     // photon noise: variance per linear signal
  double saturation = 0.97;               // signals at or above this tell only a lower bound
};

/// A merged bracket: linear radiance (camera signal per second) with its variance.
struct HdrFrame {
  Stack radiance;
  Stack variance;
  std::vector<std::uint8_t> valid;  // per value; 0 where every exposure was saturated
};

/// Inverse-variance weighted mean of the unsaturated exposures,
///   L = sum_k w_k z_k / t_k / sum_k w_k,   w_k = t_k^2 / (read^2 + gain * z_k).
/// z_k in the weight is predicted from the current L, so that the weights do not follow the noise.
/// Shapes: all cameras' pixels, see Rasters.  Source: core/hdr/README.md.
HdrFrame mergeBracket(const Shot& shot, const std::vector<CameraModel>& cameras, const Rasters& rasters);

/// The mean of several frames of the same light; variances of the mean.
HdrFrame meanOf(const std::vector<HdrFrame>& frames);

}  // namespace relucent
