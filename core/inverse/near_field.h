// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "relucent/transport/transport_matrix.h"

namespace relucent::inverse {

/// The bright part of every row of T, with the colours unmixed and so reduced to one number a projector
/// channel: value(leaf) = diag(U_i T_i,leaf), zero rows where a camera pixel is not usable.
/// A leaf belongs to the near field if its value per projector pixel is at least `nearShare` of the row's
/// largest, whatever its level: this excludes wide, dim leaves of far light, but includes wide leaves with
/// the direct light of a T that was not measured more finely.
/// 10 bytes a leaf: values are 16-bit fixed point with a step for each row, wrong by half of that at most,
/// 1.5e-5 of the row's largest value.
struct NearField {
  using Value = std::array<float, 4>;  // three channels and padding to a vector register
  using Code = std::array<std::int16_t, 3>;

  LargeVector<transport::ColourBlock> unmix;  // U_i per camera pixel
  LargeVector<Value> flood;                   // U_i B_i 1: the unmixed flood image, 1 up to regularisation
  std::vector<std::size_t> start;             // leaves of row i: [start[i], start[i + 1])
  std::vector<float> step;                    // of row i's codes
  LargeVector<std::uint32_t> node;            // index in the NodeLayout
  LargeVector<Code> code;

  /// Of a leaf of a row.
  Value value(std::size_t row, std::size_t leaf) const {
    const auto& [red, green, blue] = code[leaf];
    return {step[row] * static_cast<float>(red), step[row] * static_cast<float>(green),
            step[row] * static_cast<float>(blue), 0.0f};
  }
};

NearField nearFieldOf(const transport::TransportMatrix& transport, const CameraMask& usable);

}  // namespace relucent::inverse
