// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "relucent/hdr/response_curve.h"
#include "relucent/rig/shot.h"

namespace relucent::linearization {

/// A camera's response, estimated from one light at several exposures.
struct CameraResponse {
  std::array<hdr::ResponseCurve, 3> curves;  // the identity where the camera is linear
  double exponent = 1.0;                     // of the power law closest to the measured curve, worst channel
  double deviation = 0.0;                    // largest relative deviation from that power law
};

/// Exposures for estimating a response: from the longest of `exposures` to a quarter of the shortest, within
/// the camera's range, in alternating steps of 2 and 1.5. Equal steps would leave every response that repeats
/// from step to step, f(2 z) = 2 f(z), as likely as the straight line.
std::vector<double> responseBracket(const rig::ExposureRange& range, const std::vector<double>& exposures);

/// Whether few exposures, far apart, speak for a linear camera. Between neighbours, over values that are well
/// exposed in both, the ratio of sums follows the nominal times, to 0.04 in the exponent over all of them,
/// and is the same for the brighter half as for the darker one to 0.03. Ratios of sums are free of the bias
/// that noise gives to slopes, which a scene of few different brightnesses would leave to cameraResponse().
bool looksLinear(const rig::Shot& bracket, std::size_t camera, double saturation);

/// Least squares over pixels i and exposures k, in logarithms, after Debevec & Malik 1997:
///   u(z_ik) - ln t_k - d_k = l_i,
/// u = ln response, linear between knots that are even in ln z, so that a linear camera and every power law
/// are represented exactly; d_k are errors of the nominal exposure times (0.03 a priori, no power law
/// among them), l_i the light, eliminated. Second differences of u are penalised where there are no data. A
/// camera counts as linear unless its exponent is off by more than 0.04 (the effect of errors of 5 % in the
/// times) or its shape by more than 0.03.  Source: core/linearization/README.md, [DEB].
CameraResponse cameraResponse(const rig::Shot& bracket, std::size_t camera, double saturation);

}  // namespace relucent::linearization
