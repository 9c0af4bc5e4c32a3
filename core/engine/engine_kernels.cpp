// SPDX-License-Identifier: MIT
// GCC's vector extensions, as in transport/block_kernels.cpp: they compile for every processor, and once more
// for those with AVX2 and FMA. Which one runs is chosen while the program runs.
#include "engine/engine_kernels.h"

#include <cstring>

#include "transport/code_lanes.h"

namespace relucent {
namespace {

using namespace detail;
using WideIntegers [[gnu::vector_size(32)]] = std::int32_t;
using WideFloats [[gnu::vector_size(32)]] = float;

/// A leaf's three codes times 65536, and in the fourth lane its column as if that were a code.
RELUCENT_KERNEL Floats lanesOf(const PackedLeaf& leaf) {
  constexpr Codes zero{};
  std::int64_t whole;
  std::memcpy(&whole, &leaf, sizeof whole);
  Codes codes = reinterpret_cast<Codes>(Longs{whole, 0});
  return floatsOf(__builtin_shufflevector(zero, codes, 0, 8, 1, 9, 2, 10, 3, 11));
}

RELUCENT_KERNEL void addEight(WideFloats& sum, const std::int16_t* from, float factor) {
  Codes codes;
  std::memcpy(&codes, from, sizeof codes);
  // In two steps: compilers know one instruction for each.
  sum += factor * __builtin_convertvector(__builtin_convertvector(codes, WideIntegers), WideFloats);
}

/// In two steps, each of them one instruction; what is no number becomes 0.
RELUCENT_KERNEL void clampEight(WideFloats& values) {
  constexpr WideFloats zero{}, one = zero + 1.0f;
  values = values > zero ? values : zero;
  values = values < one ? values : one;
}

RELUCENT_KERNEL void storeEight(float* to, const WideFloats& sum, float scale, bool clamped) {
  WideFloats scaled = scale * sum;
  if (clamped) clampEight(scaled);
  std::memcpy(to, &scaled, sizeof scaled);
}

RELUCENT_KERNEL void windowOf(const WindowArrays& windows, std::size_t tile, const float* unmixed,
                              bool clamped, float* values) {
  constexpr std::size_t lanes = 16;  // pixels at once: six sums, which stay in registers
  const auto pixels = static_cast<std::size_t>(windows.tile * windows.tile);
  const std::size_t begin = windows.start[tile], end = windows.start[tile + 1];
  const float* scale = windows.scale + 3 * tile;
  for (std::size_t part = 0; part < pixels; part += lanes) {
    WideFloats redLow{}, redHigh{}, greenLow{}, greenHigh{}, blueLow{}, blueHigh{};
    const std::int16_t* code = windows.weight + 3 * pixels * begin + part;
    for (std::size_t k = begin; k < end; ++k, code += 3 * pixels) {
      const float* in = unmixed + 4 * std::size_t{windows.row[k]};
      addEight(redLow, code, in[0]);
      addEight(redHigh, code + 8, in[0]);
      addEight(greenLow, code + pixels, in[1]);
      addEight(greenHigh, code + pixels + 8, in[1]);
      addEight(blueLow, code + 2 * pixels, in[2]);
      addEight(blueHigh, code + 2 * pixels + 8, in[2]);
    }
    storeEight(values + part, redLow, scale[0], clamped);
    storeEight(values + part + 8, redHigh, scale[0], clamped);
    storeEight(values + pixels + part, greenLow, scale[1], clamped);
    storeEight(values + pixels + part + 8, greenHigh, scale[1], clamped);
    storeEight(values + 2 * pixels + part, blueLow, scale[2], clamped);
    storeEight(values + 2 * pixels + part + 8, blueHigh, scale[2], clamped);
  }
}

template <bool correct>
RELUCENT_KERNEL void passOver(const PatchRows& rows, const CameraArrays& camera, float* columns) {
  constexpr std::size_t stride = correct ? correctColumn : stepColumn;
  for (std::size_t row = rows.rowBegin; row < rows.rowEnd; ++row) {
    const PackedLeaf* const begin = rows.leaf + rows.leafStart[row];
    const PackedLeaf* const end = rows.leaf + rows.leafStart[row + 1];
    const std::size_t pixel = rows.pixel[row];
    const float weight = camera.weight[pixel];
    if (!(weight > 0.0f)) {
      if constexpr (correct) std::memset(camera.unmixed + 4 * pixel, 0, 4 * sizeof(float));
      continue;
    }

    Floats even{}, odd{};
    const PackedLeaf* leaf = begin;
    for (; leaf + 1 < end; leaf += 2) {
      even += lanesOf(leaf[0]) * load(columns + stride * leaf[0].column);
      odd += lanesOf(leaf[1]) * load(columns + stride * leaf[1].column);
    }
    if (leaf < end) even += lanesOf(*leaf) * load(columns + stride * leaf->column);
    const Floats seen = lanesToCodes * (even + odd);

    const float* m = rows.mixing + 9 * row;
    const float* wanted = camera.wanted + 3 * pixel;
    float residual[3];
    for (std::size_t c = 0; c < 3; ++c)
      residual[c] =
          weight * (wanted[c] - (m[3 * c] * seen[0] + m[3 * c + 1] * seen[1] + m[3 * c + 2] * seen[2]));
    auto back = [m](const float* r) {
      return lanesToCodes * Floats{m[0] * r[0] + m[3] * r[1] + m[6] * r[2],
                                   m[1] * r[0] + m[4] * r[1] + m[7] * r[2],
                                   m[2] * r[0] + m[5] * r[1] + m[8] * r[2], 0.0f};
    };
    const Floats down = back(residual);

    if constexpr (!correct) {
      for (leaf = begin; leaf < end; ++leaf) {
        float* sum = columns + stride * leaf->column + 4;
        Floats more = load(sum) + lanesOf(*leaf) * down;
        std::memcpy(sum, &more, sizeof more);
      }
    } else {
      const float* u = camera.unmix + 9 * pixel;
      float* unmixed = camera.unmixed + 4 * pixel;
      for (std::size_t c = 0; c < 3; ++c)
        unmixed[c] = u[3 * c] * residual[0] + u[3 * c + 1] * residual[1] + u[3 * c + 2] * residual[2];
      unmixed[3] = 0.0f;
      const float* lit = camera.lit + 3 * pixel;
      const float weighted[3] = {weight * lit[0], weight * lit[1], weight * lit[2]};
      const Floats bound = back(weighted);
      for (leaf = begin; leaf < end; ++leaf) {
        float* sum = columns + stride * leaf->column + 4;
        const Floats codes = lanesOf(*leaf);
        Floats first = load(sum) + codes * down, second = load(sum + 4) + codes * bound;
        std::memcpy(sum, &first, sizeof first);
        std::memcpy(sum + 4, &second, sizeof second);
      }
    }
  }
}

/// Eight values of an update in place; `cut` counts down where a value is visibly cut off.
RELUCENT_KERNEL void updateEight(float* p, const float* c, const float* back, float length,
                                 WideIntegers& cut) {
  WideFloats value, factor, more;
  std::memcpy(&value, p, sizeof value);
  std::memcpy(&factor, c, sizeof factor);
  std::memcpy(&more, back, sizeof more);
  value += length * factor * more;
  cut += (value < -visibleCut) | (value > 1.0f + visibleCut);
  clampEight(value);
  std::memcpy(p, &value, sizeof value);
}

RELUCENT_KERNEL std::size_t updateAll(float* p, const float* c, const float* back, float length,
                                      std::size_t count) {
  constexpr std::size_t lanes = 8;
  WideIntegers cut{};
  std::size_t i = 0;
  for (; i + lanes <= count; i += lanes) updateEight(p + i, c + i, back + i, length, cut);
  if (i < count) {
    float rest[3][lanes] = {};
    const std::size_t bytes = (count - i) * sizeof(float);
    std::memcpy(rest[0], p + i, bytes);
    std::memcpy(rest[1], c + i, bytes);
    std::memcpy(rest[2], back + i, bytes);
    updateEight(rest[0], rest[1], rest[2], length, cut);
    std::memcpy(p + i, rest[0], bytes);
  }
  std::size_t sum = 0;
  for (std::size_t lane = 0; lane < lanes; ++lane) sum += static_cast<std::size_t>(-cut[lane]);
  return sum;
}

RELUCENT_KERNEL void reciprocalOf(float* c, const float* free, float least, std::size_t count) {
  constexpr std::size_t lanes = 8;
  std::size_t i = 0;
  for (; i + lanes <= count; i += lanes) {
    WideFloats value, numerator;
    std::memcpy(&value, c + i, sizeof value);
    std::memcpy(&numerator, free + i, sizeof numerator);
    WideFloats quotient = numerator / value;
    quotient = value > least ? quotient : WideFloats{};
    std::memcpy(c + i, &quotient, sizeof quotient);
  }
  for (; i < count; ++i) c[i] = c[i] > least ? free[i] / c[i] : 0.0f;
}

// One version of each for an instruction set.
#define RELUCENT_KERNELS(set, ...)                                                                   \
  __VA_ARGS__ void window##set(const WindowArrays& windows, std::size_t tile, const float* unmixed,  \
                               bool clamped, float* values) {                                        \
    windowOf(windows, tile, unmixed, clamped, values);                                               \
  }                                                                                                  \
  __VA_ARGS__ void step##set(const PatchRows& rows, const CameraArrays& camera, float* columns) {    \
    passOver<false>(rows, camera, columns);                                                          \
  }                                                                                                  \
  __VA_ARGS__ void correct##set(const PatchRows& rows, const CameraArrays& camera, float* columns) { \
    passOver<true>(rows, camera, columns);                                                           \
  }                                                                                                  \
  __VA_ARGS__ std::size_t update##set(float* p, const float* c, const float* back, float length,     \
                                      std::size_t count) {                                           \
    return updateAll(p, c, back, length, count);                                                     \
  }                                                                                                  \
  __VA_ARGS__ void reciprocal##set(float* c, const float* free, float least, std::size_t count) {    \
    reciprocalOf(c, free, least, count);                                                             \
  }

RELUCENT_KERNELS(Baseline)
#ifdef __x86_64__
RELUCENT_KERNELS(Avx2, [[gnu::target("avx2,fma")]])
#endif

}  // namespace

std::span<const EngineKernels> engineKernels() {
#ifdef __x86_64__
  static const EngineKernels all[] = {
      {"baseline", windowBaseline, stepBaseline, correctBaseline, updateBaseline, reciprocalBaseline},
      {"AVX2, FMA", windowAvx2, stepAvx2, correctAvx2, updateAvx2, reciprocalAvx2}};
  static const bool newer = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  return {all, newer ? 2u : 1u};
#else
  static const EngineKernels all[] = {
      {"baseline", windowBaseline, stepBaseline, correctBaseline, updateBaseline, reciprocalBaseline}};
  return all;
#endif
}

}  // namespace relucent
