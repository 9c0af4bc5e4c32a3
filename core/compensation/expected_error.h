// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "relucent/compensation/target.h"
#include "relucent/transport/transport_matrix.h"

namespace relucent::compensation {

/// What a measurement tells of its own errors. Shapes: camera stacks of radiance squared.
struct TransportVariance {
  CameraStack black;  // of e
  CameraStack flood;  // of T 1
  CameraStack leaf;   // of each row's leaves, mean
};

/// The standard deviation of what the cameras see of a picture p, beside T p + e:
///   sigma^2 = 0.88 var(e) + 0.71 m^2 var(T 1) + 0.13 var(t) sum_k |v_k - a|^2 + 24 sum_k t_k^2 s_k^2 / n_k,
///   m = T p / T 1
/// over a row's leaves t_k: v_k the picture's mean over the leaf's n_k projector pixels, s_k^2 its variance
/// among them, a the mean of all v_k, by the leaves' light. That all leaves together are as bright as T 1 is
/// known better than any of them. The factors are fitted to simulated venues' truth so that `within95`
/// sigma hold in 95 % of all values. Source: core/compensation/README.md. Shapes: `variance` of T's cameras,
/// `picture` of its projectors; the result is radiance.
CameraStack expectedDeviation(const transport::TransportMatrix& transport, const TransportVariance& variance,
                              const ProjectorStack& picture);

inline constexpr float within95 = 1.96f;

/// How far what the cameras see of a picture may be from its prediction: 95 % of all values come within.
struct ExpectedError {
  CameraStack radiance;             // within95 times expectedDeviation()
  std::vector<float> shareOfWhite;  // per camera pixel, of the content's white there: root of the mean square
                                    // of the channels; NaN outside the content
  bool isKnown() const { return !radiance.empty(); }
  /// The root of the mean square over one camera's content; 0 without any.
  double shareIn(std::size_t camera, const Rasters& cameras) const;
  double shareOverall() const;
};

/// Of a compensation for `target`. Not known where nothing is of the leaves' errors, as of an import.
ExpectedError expectedError(const MeasuredVenue& venue, const TransportVariance& variance,
                            const Target& target, const ProjectorStack& picture);

}  // namespace relucent::compensation
