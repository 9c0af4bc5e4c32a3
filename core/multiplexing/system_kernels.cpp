// SPDX-License-Identifier: MIT
// GCC's vector extensions, which Clang has too. The version for newer processors is chosen when the program
// runs, as in transport/block_kernels.cpp.
#include "relucent/multiplexing/system_kernels.h"

#include <algorithm>
#include <array>
#include <cstring>

#define RELUCENT_KERNEL [[gnu::always_inline]] inline

namespace relucent::multiplexing {
namespace {

using Lanes [[gnu::vector_size(4 * lanes)]] = float;

RELUCENT_KERNEL void load(Lanes& to, const float* from) {
  std::memcpy(&to, from, sizeof to);
}

RELUCENT_KERNEL float sumOf(const Lanes& values) {
  using Half [[gnu::vector_size(2 * lanes)]] = float;
  using Quarter [[gnu::vector_size(lanes)]] = float;
  Half half = __builtin_shufflevector(values, values, 0, 1, 2, 3) +
              __builtin_shufflevector(values, values, 4, 5, 6, 7);
  Quarter quarter = __builtin_shufflevector(half, half, 0, 1) + __builtin_shufflevector(half, half, 2, 3);
  return quarter[0] + quarter[1];
}

/// The products of up to `across` columns with up to `down` others.
template <int down, int across>
RELUCENT_KERNEL void tile(const float* rows, const float* columns, std::size_t length, float* gram,
                          std::size_t stride) {
  Lanes sums[down][across] = {};
  for (std::size_t n = 0; n < length; n += lanes) {
    // Unrolled, so that all of them are registers.
    Lanes row[down];
#pragma GCC unroll 4
    for (int i = 0; i < down; ++i) load(row[i], rows + static_cast<std::size_t>(i) * length + n);
#pragma GCC unroll 4
    for (int j = 0; j < across; ++j) {
      Lanes column;
      load(column, columns + static_cast<std::size_t>(j) * length + n);
#pragma GCC unroll 4
      for (int i = 0; i < down; ++i) sums[i][j] += row[i] * column;
    }
  }
#pragma GCC unroll 4
  for (int i = 0; i < down; ++i)
#pragma GCC unroll 4
    for (int j = 0; j < across; ++j)
      gram[static_cast<std::size_t>(i) * stride + static_cast<std::size_t>(j)] = sumOf(sums[i][j]);
}

RELUCENT_KERNEL void gramOf(const float* columns, std::size_t length, std::size_t count, float* gram,
                            std::size_t stride) {
  constexpr std::size_t down = 3, across = 4;
  std::size_t i = 0;
  for (; i + down <= count; i += down) {
    std::size_t j = i;
    for (; j + across <= count; j += across)
      tile<down, across>(columns + i * length, columns + j * length, length, gram + i * stride + j, stride);
    for (; j < count; ++j)
      tile<down, 1>(columns + i * length, columns + j * length, length, gram + i * stride + j, stride);
  }
  for (; i < count; ++i)
    for (std::size_t j = i; j < count; ++j)
      tile<1, 1>(columns + i * length, columns + j * length, length, gram + i * stride + j, stride);
}

/// to -= factor * from, from `first` on, which may begin earlier, at a multiple of the lanes.
RELUCENT_KERNEL void subtract(float* to, const float* from, float factor, std::size_t first,
                              std::size_t end) {
  for (std::size_t j = first / lanes * lanes; j < end; j += lanes) {
    Lanes a, b;
    load(a, to + j);
    load(b, from + j);
    a -= factor * b;
    std::memcpy(to + j, &a, sizeof a);
  }
}

RELUCENT_KERNEL void eliminateIn(float* matrix, std::size_t stride, std::size_t order, std::size_t unknowns) {
  for (std::size_t k = 0; k < unknowns; ++k) {
    float* pivot = matrix + k * stride;
    pivot[k] = std::max(pivot[k], 1.0f);
    float scale = 1.0f / pivot[k];
    for (std::size_t i = k + 1; i < order; ++i)
      subtract(matrix + i * stride, pivot, scale * pivot[i], i, order);
  }
}

RELUCENT_KERNEL void invertIn(const float* upper, std::size_t stride, std::size_t order, float* inverse) {
  for (std::size_t i = order; i-- > 0;) {
    float* row = inverse + i * stride;
    std::fill(row, row + padded(order), 0.0f);
    float scale = 1.0f / upper[i * stride + i];
    for (std::size_t j = i + 1; j < order; ++j)
      subtract(row, inverse + j * stride, scale * upper[i * stride + j], j, order);
    row[i] = scale;
  }
}

#define RELUCENT_SYSTEM_KERNELS(set, ...)                                                                   \
  __VA_ARGS__ void gram##set(const float* columns, std::size_t length, std::size_t count, float* gram,      \
                             std::size_t stride) {                                                          \
    gramOf(columns, length, count, gram, stride);                                                           \
  }                                                                                                         \
  __VA_ARGS__ void eliminate##set(float* matrix, std::size_t stride, std::size_t order,                     \
                                  std::size_t unknowns) {                                                   \
    eliminateIn(matrix, stride, order, unknowns);                                                           \
  }                                                                                                         \
  __VA_ARGS__ void invert##set(const float* upper, std::size_t stride, std::size_t order, float* inverse) { \
    invertIn(upper, stride, order, inverse);                                                                \
  }

RELUCENT_SYSTEM_KERNELS(Baseline)
#ifdef __x86_64__
RELUCENT_SYSTEM_KERNELS(Avx2, [[gnu::target("avx2,fma")]])
#endif

}  // namespace

std::span<const SystemKernels> systemKernels() {
#ifdef __x86_64__
  static const SystemKernels all[] = {{"baseline", gramBaseline, eliminateBaseline, invertBaseline},
                                      {"AVX2, FMA", gramAvx2, eliminateAvx2, invertAvx2}};
  static const bool newer = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  return {all, newer ? 2u : 1u};
#else
  static const SystemKernels all[] = {{"baseline", gramBaseline, eliminateBaseline, invertBaseline}};
  return all;
#endif
}

}  // namespace relucent::multiplexing
