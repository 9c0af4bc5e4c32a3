// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <span>

namespace relucent::multiplexing {

/// Lengths of columns and rows that the kernels read are multiples of this; what is beyond the end is zero.
inline constexpr std::size_t lanes = 16;
constexpr std::size_t padded(std::size_t count) {
  return (count + lanes - 1) / lanes * lanes;
}

/// The inner loops of the regression, for one instruction set, in single precision. Matrices are symmetric,
/// their upper triangle is stored row by row, `stride` values apart; what is below the diagonal has no
/// meaning.
struct SystemKernels {
  const char* instructions;
  /// Sum of (column - 1/2)^2.
  float (*variation)(const float* column, std::size_t length);
  /// light += factor * column,  square += squared * (column - 1/2)^2.
  void (*gather)(const float* column, std::size_t length, float factor, float* light, float squared,
                 float* square);
  /// What a leaf shows: weight * sum over k of mixing[k] * design[k].  column = spread * that,
  /// left -= expected * that.
  void (*weigh)(const std::array<const float*, 3>& design, std::size_t length,
                const std::array<float, 3>& mixing, const float* weight, float spread, float* column,
                float expected, float* left);
  /// light[c] += sum over k of block[3 c + k] * design[k].
  void (*relight)(const std::array<const float*, 3>& design, std::size_t length, const float* block,
                  const std::array<float*, 3>& light);
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
