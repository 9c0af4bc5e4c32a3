// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>

namespace relucent::multiplexing {

/// Lengths of columns and rows that the kernels read are multiples of this; what is beyond the end is zero.
inline constexpr std::size_t lanes = 8;
constexpr std::size_t padded(std::size_t count) {
  return (count + lanes - 1) / lanes * lanes;
}

/// The inner loops of the regression, for one instruction set, in single precision. Matrices are symmetric,
/// their upper triangle is stored row by row, `stride` values apart; what is below the diagonal has no
/// meaning.
struct SystemKernels {
  const char* instructions;
  /// G = X^T X.  X: `count` columns of `length` values each, one after the other.
  void (*gram)(const float* columns, std::size_t length, std::size_t count, float* gram, std::size_t stride);
  /// Eliminates the first `unknowns` of `order`: G = R^T D^-1 R for their rows, which become R, whose
  /// diagonal is D; what is left is the Schur complement. Every unknown has a prior of variance 1, so that no
  /// pivot is below 1 but for rounding; then it counts as 1.
  void (*eliminate)(float* matrix, std::size_t stride, std::size_t order, std::size_t unknowns);
  /// The inverse of an upper triangular matrix, upper triangular too.
  void (*invert)(const float* upper, std::size_t stride, std::size_t order, float* inverse);
};

/// All that this processor can run, the fastest last.
std::span<const SystemKernels> systemKernels();

}  // namespace relucent::multiplexing
