// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "relucent/hdr/response_curve.h"

namespace relucent::hdr {

/// The non-decreasing sequence closest to `values`: minimises sum_i weights_i (result_i - values_i)^2.
/// Weights are positive.  Source: pool adjacent violators, Ayer et al. 1955; core/hdr/README.md, [AYE].
std::vector<double> isotonic(const std::vector<double>& values, const std::vector<double>& weights);

/// A curve from a measured ramp, normalised to 0 -> 0 and 1 -> 1: isotonic regression, then monotone cubic.
/// `x` ascends from 0 to 1. Samples that the regression pools within the ramp become one sample at their
/// weighted mean, so noise leaves no steps. Plateaus at black and white (crushed shadows, clipped lights) are
/// kept and get the slope `leastSlope`, so that the curve can be inverted.
/// Throws: Error{numerics} if the ramp does not rise at all.
ResponseCurve curveFromRamp(const std::vector<double>& x, const std::vector<double>& y,
                            const std::vector<double>& weights);

/// Least slope of a curve from a ramp, in units of the mean slope: below the resolution of any display.
inline constexpr double leastSlope = 1e-6;

}  // namespace relucent::hdr
