// SPDX-License-Identifier: MIT
#pragma once

#include "relucent/transport/transport_matrix.h"

namespace relucent::transport {

/// Difference between two transport matrices over all single projector pixels:
///   frobenius = |T - R|_F / |R|_F,   row error = |T_i - R_i|_F / |R_i|_F.
struct TransportDifference {
  double frobenius = 0.0;
  double rowMedian = 0.0;
  double rowP95 = 0.0;
  std::size_t rows = 0;  // rows with light in the reference; the row statistics are taken over these
};

/// Compares without expanding to pixels. A row is a sum of uniform blocks; with densities d = value / pixels
/// of the block, blocks nested or disjoint,
///   |row|^2 = sum_k n_k |d_k|^2 + 2 sum_k n_k d_k . (sum of the densities of k's ancestors).
/// Throws: std::logic_error unless both belong to the same devices.
TransportDifference difference(const TransportMatrix& transport, const TransportMatrix& reference);

/// Camera pixels whose leaves, or the sums of them, are not the same to the bit: what follows from a row
/// alone need not be worked out again where they are. Throws: std::logic_error unless both belong to the same
/// devices.
CameraMask differingRows(const TransportMatrix& transport, const TransportMatrix& reference);

}  // namespace relucent::transport
