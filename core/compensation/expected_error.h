// SPDX-License-Identifier: MIT
#pragma once

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

}  // namespace relucent::compensation
