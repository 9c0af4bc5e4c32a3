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

/// As many values as a register holds.
template <std::size_t width>
struct Register {
  using Lanes [[gnu::vector_size(4 * width)]] = float;
};
template <std::size_t width>
using Lanes = typename Register<width>::Lanes;

template <typename Values>
RELUCENT_KERNEL void load(Values& to, const float* from) {
  std::memcpy(&to, from, sizeof to);
}
template <typename Values>
RELUCENT_KERNEL void store(float* to, const Values& from) {
  std::memcpy(to, &from, sizeof from);
}

template <std::size_t width>
RELUCENT_KERNEL float sumOf(const Lanes<width>& values) {
  if constexpr (width > 4) {
    Lanes<width / 2> low, high;
    std::memcpy(&low, &values, sizeof low);
    std::memcpy(&high, reinterpret_cast<const char*>(&values) + sizeof low, sizeof high);
    low += high;
    return sumOf<width / 2>(low);
  } else {
    return (values[0] + values[2]) + (values[1] + values[3]);
  }
}

template <std::size_t width>
RELUCENT_KERNEL float variationOf(const float* column, std::size_t length) {
  Lanes<width> sum = {};
  for (std::size_t n = 0; n < length; n += width) {
    Lanes<width> value;
    load(value, column + n);
    value -= 0.5f;
    sum += value * value;
  }
  return sumOf<width>(sum);
}

template <std::size_t width>
RELUCENT_KERNEL void gatherFrom(const float* column, std::size_t length, float factor, float* light,
                                float squared, float* square) {
  for (std::size_t n = 0; n < length; n += width) {
    Lanes<width> value, sum, squares;
    load(value, column + n);
    load(sum, light + n);
    load(squares, square + n);
    store(light + n, sum + factor * value);
    value -= 0.5f;
    store(square + n, squares + squared * (value * value));
  }
}

template <std::size_t width>
RELUCENT_KERNEL void weighIn(const std::array<const float*, 3>& design, std::size_t length,
                             const std::array<float, 3>& mixing, const float* weight, float spread,
                             float* column, float expected, float* left) {
  for (std::size_t n = 0; n < length; n += width) {
    Lanes<width> red, green, blue, weights, rest;
    load(red, design[0] + n);
    load(green, design[1] + n);
    load(blue, design[2] + n);
    load(weights, weight + n);
    load(rest, left + n);
    const Lanes<width> shown = weights * (mixing[0] * red + mixing[1] * green + mixing[2] * blue);
    store(column + n, spread * shown);
    store(left + n, rest - expected * shown);
  }
}

template <std::size_t width>
RELUCENT_KERNEL void relightFrom(const std::array<const float*, 3>& design, std::size_t length,
                                 const float* block, const std::array<float*, 3>& light) {
  for (std::size_t n = 0; n < length; n += width) {
    Lanes<width> red, green, blue;
    load(red, design[0] + n);
    load(green, design[1] + n);
    load(blue, design[2] + n);
#pragma GCC unroll 3
    for (std::size_t c = 0; c < 3; ++c) {
      Lanes<width> sum;
      load(sum, light[c] + n);
      store(light[c] + n, sum + (block[3 * c] * red + block[3 * c + 1] * green + block[3 * c + 2] * blue));
    }
  }
}

/// The products of up to `across` columns with up to `down` others.
template <std::size_t width, std::size_t down, std::size_t across>
RELUCENT_KERNEL void tile(const float* rows, const float* columns, std::size_t length, float* gram,
                          std::size_t stride) {
  Lanes<width> sums[down][across] = {};
  for (std::size_t n = 0; n < length; n += width) {
    // Unrolled, so that all of them are registers.
    Lanes<width> row[down];
#pragma GCC unroll 8
    for (std::size_t i = 0; i < down; ++i) load(row[i], rows + i * length + n);
#pragma GCC unroll 8
    for (std::size_t j = 0; j < across; ++j) {
      Lanes<width> column;
      load(column, columns + j * length + n);
#pragma GCC unroll 8
      for (std::size_t i = 0; i < down; ++i) sums[i][j] += row[i] * column;
    }
  }
#pragma GCC unroll 8
  for (std::size_t i = 0; i < down; ++i)
#pragma GCC unroll 8
    for (std::size_t j = 0; j < across; ++j) gram[i * stride + j] = sumOf<width>(sums[i][j]);
}

/// Tiles of as many sums as there are registers for.
template <std::size_t width, std::size_t down, std::size_t across>
RELUCENT_KERNEL void gramOf(const float* columns, std::size_t length, std::size_t count, float* gram,
                            std::size_t stride) {
  std::size_t i = 0;
  for (; i + down <= count; i += down) {
    std::size_t j = i;
    for (; j + across <= count; j += across)
      tile<width, down, across>(columns + i * length, columns + j * length, length, gram + i * stride + j,
                                stride);
    for (; j < count; ++j)
      tile<width, down, 1>(columns + i * length, columns + j * length, length, gram + i * stride + j, stride);
  }
  for (; i < count; ++i)
    for (std::size_t j = i; j < count; ++j)
      tile<width, 1, 1>(columns + i * length, columns + j * length, length, gram + i * stride + j, stride);
}

/// to -= sum over `rows` of factor[r] * from[r], from `first` on, which may begin earlier, at a multiple of
/// the width: several at once, so that each value is loaded and stored once.
template <std::size_t width, std::size_t rows>
RELUCENT_KERNEL void subtract(float* to, const std::array<const float*, rows>& from,
                              const std::array<float, rows>& factor, std::size_t first, std::size_t end) {
  for (std::size_t j = first / width * width; j < end; j += width) {
    Lanes<width> a;
    load(a, to + j);
#pragma GCC unroll 4
    for (std::size_t r = 0; r < rows; ++r) {
      Lanes<width> b;
      load(b, from[r] + j);
      a -= factor[r] * b;
    }
    store(to + j, a);
  }
}

constexpr std::size_t together = 4;  // rows

template <std::size_t width>
RELUCENT_KERNEL void eliminateIn(float* matrix, std::size_t stride, std::size_t order, std::size_t unknowns) {
  for (std::size_t first = 0; first < unknowns; first += together) {
    std::size_t last = std::min(first + together, unknowns);
    for (std::size_t k = first; k < last; ++k) {
      float* pivot = matrix + k * stride;
      pivot[k] = std::max(pivot[k], 1.0f);
      for (std::size_t i = k + 1; i < last; ++i)
        subtract<width, 1>(matrix + i * stride, {pivot}, {1.0f / pivot[k] * pivot[i]}, i, order);
    }
    if (last - first == together) {
      std::array<const float*, together> pivots;
      std::array<float, together> scales, factors;
      for (std::size_t r = 0; r < together; ++r) {
        pivots[r] = matrix + (first + r) * stride;
        scales[r] = 1.0f / pivots[r][first + r];
      }
      for (std::size_t i = last; i < order; ++i) {
        for (std::size_t r = 0; r < together; ++r) factors[r] = scales[r] * pivots[r][i];
        subtract<width, together>(matrix + i * stride, pivots, factors, i, order);
      }
    } else {
      for (std::size_t k = first; k < last; ++k) {
        const float* pivot = matrix + k * stride;
        for (std::size_t i = last; i < order; ++i)
          subtract<width, 1>(matrix + i * stride, {pivot}, {1.0f / pivot[k] * pivot[i]}, i, order);
      }
    }
  }
}

template <std::size_t width>
RELUCENT_KERNEL void invertIn(const float* upper, std::size_t stride, std::size_t order, float* inverse) {
  for (std::size_t i = order; i-- > 0;) {
    float* row = inverse + i * stride;
    std::fill(row, row + padded(order), 0.0f);
    const float scale = 1.0f / upper[i * stride + i];
    std::size_t j = i + 1;
    for (; j + together <= order; j += together) {
      std::array<const float*, together> rows;
      std::array<float, together> factors;
      for (std::size_t r = 0; r < together; ++r) {
        rows[r] = inverse + (j + r) * stride;
        factors[r] = scale * upper[i * stride + j + r];
      }
      subtract<width, together>(row, rows, factors, j, order);
    }
    for (; j < order; ++j)
      subtract<width, 1>(row, {inverse + j * stride}, {scale * upper[i * stride + j]}, j, order);
    row[i] = scale;
  }
}

/// `set`: what follows the names of its functions; `width`: of its registers; tiles of `down` x `across`.
#define RELUCENT_SYSTEM_KERNELS(set, width, down, across, ...)                                              \
  __VA_ARGS__ float variation##set(const float* column, std::size_t length) {                               \
    return variationOf<width>(column, length);                                                              \
  }                                                                                                         \
  __VA_ARGS__ void gather##set(const float* column, std::size_t length, float factor, float* light,         \
                               float squared, float* square) {                                              \
    gatherFrom<width>(column, length, factor, light, squared, square);                                      \
  }                                                                                                         \
  __VA_ARGS__ void weigh##set(const std::array<const float*, 3>& design, std::size_t length,                \
                              const std::array<float, 3>& mixing, const float* weight, float spread,        \
                              float* column, float expected, float* left) {                                 \
    weighIn<width>(design, length, mixing, weight, spread, column, expected, left);                         \
  }                                                                                                         \
  __VA_ARGS__ void relight##set(const std::array<const float*, 3>& design, std::size_t length,              \
                                const float* block, const std::array<float*, 3>& light) {                   \
    relightFrom<width>(design, length, block, light);                                                       \
  }                                                                                                         \
  __VA_ARGS__ void gram##set(const float* columns, std::size_t length, std::size_t count, float* gram,      \
                             std::size_t stride) {                                                          \
    gramOf<width, down, across>(columns, length, count, gram, stride);                                      \
  }                                                                                                         \
  __VA_ARGS__ void eliminate##set(float* matrix, std::size_t stride, std::size_t order,                     \
                                  std::size_t unknowns) {                                                   \
    eliminateIn<width>(matrix, stride, order, unknowns);                                                    \
  }                                                                                                         \
  __VA_ARGS__ void invert##set(const float* upper, std::size_t stride, std::size_t order, float* inverse) { \
    invertIn<width>(upper, stride, order, inverse);                                                         \
  }
#define RELUCENT_SYSTEM_KERNELS_OF(set, instructions)        \
  {instructions, variation##set, gather##set,    weigh##set, \
   relight##set, gram##set,      eliminate##set, invert##set}

RELUCENT_SYSTEM_KERNELS(Baseline, 4, 3, 4)
#ifdef __x86_64__
RELUCENT_SYSTEM_KERNELS(Avx2, 8, 3, 4, [[gnu::target("avx2,fma")]])
RELUCENT_SYSTEM_KERNELS(Avx512, 16, 4, 6, [[gnu::target("avx512f,avx512dq,avx512vl,avx2,fma")]])
#endif

}  // namespace

std::span<const SystemKernels> systemKernels() {
#ifdef __x86_64__
  static const SystemKernels all[] = {RELUCENT_SYSTEM_KERNELS_OF(Baseline, "baseline"),
                                      RELUCENT_SYSTEM_KERNELS_OF(Avx2, "AVX2, FMA"),
                                      RELUCENT_SYSTEM_KERNELS_OF(Avx512, "AVX-512")};
  static const bool newer = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"),
                    newest = newer && __builtin_cpu_supports("avx512f") &&
                             __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl");
  return {all, newest ? 3u : newer ? 2u : 1u};
#else
  static const SystemKernels all[] = {RELUCENT_SYSTEM_KERNELS_OF(Baseline, "baseline")};
  return all;
#endif
}

}  // namespace relucent::multiplexing
