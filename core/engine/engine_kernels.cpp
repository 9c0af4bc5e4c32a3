// SPDX-License-Identifier: MIT
// GCC's vector extensions, as in transport/block_kernels.cpp: they compile for every processor, and once more
// for those with AVX2 and FMA. Which one runs is chosen while the program runs.
#include "relucent/engine/engine_kernels.h"

#include <cstring>

#include "relucent/transport/code_lanes.h"

namespace relucent::engine {
namespace {

using namespace transport::detail;
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

RELUCENT_KERNEL void windowOf(const inverse::WindowArrays& windows, std::size_t tile, const float* unmixed,
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

/// What a run of leaves sees of its columns' light, before mixing.
RELUCENT_KERNEL Floats seenBy(const PackedLeaf* leaf, const PackedLeaf* end, const float* columns) {
  Floats sum[leavesTogether] = {};  // which need not wait for each other
  for (; leaf < end; leaf += leavesTogether)
#pragma GCC unroll 4
    for (std::size_t k = 0; k < leavesTogether; ++k)
      sum[k] += lanesOf(leaf[k]) * load(columns + stepColumn * leaf[k].column);
  return lanesToCodes * ((sum[0] + sum[1]) + (sum[2] + sum[3]));
}

/// Adds what a run sends back to its columns' sums, which lie `stride` floats apart. As the columns of a run
/// differ, some sums are read before those before them are written.
template <std::size_t stride>
RELUCENT_KERNEL void sendBack(const PackedLeaf* leaf, const PackedLeaf* end, Floats down, float* sums) {
  for (; leaf < end; leaf += leavesTogether) {
    Floats sum[leavesTogether];
#pragma GCC unroll 4
    for (std::size_t k = 0; k < leavesTogether; ++k)
      sum[k] = load(sums + stride * leaf[k].column) + lanesOf(leaf[k]) * down;
#pragma GCC unroll 4
    for (std::size_t k = 0; k < leavesTogether; ++k)
      std::memcpy(sums + stride * leaf[k].column, &sum[k], sizeof sum[k]);
  }
}

RELUCENT_KERNEL Floats loadThree(const float* from) {
  return Floats{from[0], from[1], from[2], 0.0f};
}

/// A mixing's rows; the fourth lanes hold anything.
struct Mixing {
  Floats row[3];
};

/// Reads three floats more than the mixing has.
RELUCENT_KERNEL Mixing mixingAt(const float* from) {
  return {{load(from), load(from + 3), load(from + 6)}};
}

RELUCENT_KERNEL Floats allLanes(float value) {
  return Floats{value, value, value, value};
}

RELUCENT_KERNEL Floats mixed(const Mixing& m, Floats light) {
  const Floats low = __builtin_shufflevector(m.row[0], m.row[1], 0, 4, 1, 5);
  const Floats high = __builtin_shufflevector(m.row[0], m.row[1], 2, 6, 3, 7);
  return allLanes(light[0]) * __builtin_shufflevector(low, m.row[2], 0, 1, 4, 7) +
         allLanes(light[1]) * __builtin_shufflevector(low, m.row[2], 2, 3, 5, 7) +
         allLanes(light[2]) * __builtin_shufflevector(high, m.row[2], 0, 1, 6, 7);
}

/// Light on its way back: through the transpose of a mixing. The fourth lane is 0.
RELUCENT_KERNEL Floats unmixedBack(const Mixing& m, Floats light) {
  constexpr Integers threeLanes{-1, -1, -1, 0};
  const Floats back =
      allLanes(light[0]) * m.row[0] + allLanes(light[1]) * m.row[1] + allLanes(light[2]) * m.row[2];
  return reinterpret_cast<Floats>(reinterpret_cast<Integers>(back) & threeLanes);
}

/// What the groups of a square see with their parents, and the sums of what their rows send back.
struct GroupLight {
  static constexpr std::size_t most = 1 + 4 + 16;  // of 64, 16 and 4 camera pixels
  Floats seen[most], back[most];
};

RELUCENT_KERNEL void lightGroups(const PatchRows& patch, const PackedSquare& square, const float* columns,
                                 GroupLight& light) {
  for (std::size_t i = 0; i < square.groupEnd - square.groupBegin; ++i) {
    const PackedGroup& group = patch.group[square.groupBegin + i];
    light.seen[i] = group.scale * seenBy(patch.leaf + group.leafBegin, patch.leaf + group.leafEnd, columns);
    if (group.parent != PackedGroup::none) light.seen[i] += light.seen[group.parent - square.groupBegin];
    light.back[i] = Floats{};
  }
}

/// Passes on what groups have got from their rows, the narrow ones first.
template <std::size_t stride>
RELUCENT_KERNEL void sendGroupsBack(const PatchRows& patch, const PackedSquare& square, float* sums,
                                    GroupLight& light) {
  for (std::size_t i = square.groupEnd - square.groupBegin; i-- > 0;) {
    const PackedGroup& group = patch.group[square.groupBegin + i];
    if (group.parent != PackedGroup::none) light.back[group.parent - square.groupBegin] += light.back[i];
    sendBack<stride>(patch.leaf + group.leafBegin, patch.leaf + group.leafEnd,
                     lanesToCodes * group.scale * light.back[i], sums);
  }
}

/// Through a row's leaves and to its group.
template <std::size_t stride>
RELUCENT_KERNEL void sendRowBack(const PatchRows& patch, const PackedSquare& square, const PackedRow& row,
                                 const Mixing& own, const Mixing& shared, Floats light, float* sums,
                                 GroupLight& groups) {
  if (row.group != PackedGroup::none)
    groups.back[row.group - square.groupBegin] += unmixedBack(shared, light);
  sendBack<stride>(patch.leaf + row.leafBegin, patch.leaf + row.leafEnd,
                   lanesToCodes * unmixedBack(own, light), sums);
}

// Rows ahead of which values of camera pixels are fetched: they lie in squares, which no processor foresees.
constexpr std::size_t fetchedAhead = 16;

template <bool correct>
RELUCENT_KERNEL void fetch(const CameraArrays& camera, std::size_t pixel) {
  __builtin_prefetch(camera.weight + pixel);
  __builtin_prefetch(camera.wanted + 3 * pixel);
  if constexpr (correct) {
    __builtin_prefetch(camera.unmix + 9 * pixel);
    __builtin_prefetch(camera.unmixed + 4 * pixel, 1);
  }
}

template <bool correct>
RELUCENT_KERNEL void passOverSquare(const PatchRows& patch, const PackedSquare& square,
                                    const CameraArrays& camera, float* columns) {
  GroupLight groups;
  lightGroups(patch, square, columns, groups);
  for (const PackedRow* row = patch.row + square.rowBegin; row != patch.row + square.rowEnd; ++row) {
    // The last rows of T fetch the first ones again.
    fetch<correct>(camera, row + fetchedAhead < patch.rowEnd ? row[fetchedAhead].pixel : patch.row->pixel);
    const std::size_t pixel = row->pixel;
    const float weight = camera.weight[pixel];
    if (!(weight > 0.0f)) {
      if constexpr (correct) std::memset(camera.unmixed + 4 * pixel, 0, 4 * sizeof(float));
      continue;
    }

    const Mixing own = mixingAt(row->own.data()), shared = mixingAt(row->shared.data());
    Floats seen = mixed(own, seenBy(patch.leaf + row->leafBegin, patch.leaf + row->leafEnd, columns));
    if (row->group != PackedGroup::none) seen += mixed(shared, groups.seen[row->group - square.groupBegin]);
    const Floats residual = weight * (load(camera.wanted + 3 * pixel) - seen);
    if constexpr (correct) {
      const float* u = camera.unmix + 9 * pixel;
      float* unmixed = camera.unmixed + 4 * pixel;
      for (std::size_t c = 0; c < 3; ++c)
        unmixed[c] = u[3 * c] * residual[0] + u[3 * c + 1] * residual[1] + u[3 * c + 2] * residual[2];
      unmixed[3] = 0.0f;
    }
    sendRowBack<stepColumn>(patch, square, *row, own, shared, residual, columns + 4, groups);
  }
  sendGroupsBack<stepColumn>(patch, square, columns + 4, groups);
}

template <bool correct>
RELUCENT_KERNEL void passOver(const PatchRows& patch, const CameraArrays& camera, float* columns) {
  for (const PackedSquare& square : patch.squares) passOverSquare<correct>(patch, square, camera, columns);
}

RELUCENT_KERNEL void boundOf(const PatchRows& patch, const CameraArrays& camera, float reach, float* sums) {
  for (const PackedSquare& square : patch.squares) {
    GroupLight groups;
    bool isAnyLit = false;  // mostly none is
    for (const PackedRow* row = patch.row + square.rowBegin; row != patch.row + square.rowEnd; ++row) {
      if (camera.reach[row->pixel] != reach) continue;
      if (!isAnyLit) std::memset(groups.back, 0, sizeof groups.back);
      isAnyLit = true;
      sendRowBack<sumColumn>(patch, square, *row, mixingAt(row->own.data()), mixingAt(row->shared.data()),
                             loadThree(camera.lit + 3 * std::size_t{row->pixel}), sums, groups);
    }
    if (isAnyLit) sendGroupsBack<sumColumn>(patch, square, sums, groups);
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

RELUCENT_KERNEL void reciprocalOf(float* c, const float* bound, const float* part, float share,
                                  float partShare, float least, std::size_t count) {
  constexpr float rounding = 1e-6f;
  for (std::size_t i = 0; i < count; ++i) {
    const float value = share * bound[i] + partShare * part[i];
    const float smallest = rounding * bound[i] > least ? rounding * bound[i] : least;
    c[i] = value > smallest ? 1.0f / value : 0.0f;
  }
}

// One version of each for an instruction set.
#define RELUCENT_KERNELS(set, ...)                                                                           \
  __VA_ARGS__ void window##set(const inverse::WindowArrays& windows, std::size_t tile, const float* unmixed, \
                               bool clamped, float* values) {                                                \
    windowOf(windows, tile, unmixed, clamped, values);                                                       \
  }                                                                                                          \
  __VA_ARGS__ void step##set(const PatchRows& patch, const CameraArrays& camera, float* columns) {           \
    passOver<false>(patch, camera, columns);                                                                 \
  }                                                                                                          \
  __VA_ARGS__ void correct##set(const PatchRows& patch, const CameraArrays& camera, float* columns) {        \
    passOver<true>(patch, camera, columns);                                                                  \
  }                                                                                                          \
  __VA_ARGS__ std::size_t update##set(float* p, const float* c, const float* back, float length,             \
                                      std::size_t count) {                                                   \
    return updateAll(p, c, back, length, count);                                                             \
  }                                                                                                          \
  __VA_ARGS__ void bound##set(const PatchRows& patch, const CameraArrays& camera, float reach,               \
                              float* sums) {                                                                 \
    boundOf(patch, camera, reach, sums);                                                                     \
  }                                                                                                          \
  __VA_ARGS__ void reciprocal##set(float* c, const float* bound, const float* part, float share,             \
                                   float partShare, float least, std::size_t count) {                        \
    reciprocalOf(c, bound, part, share, partShare, least, count);                                            \
  }

RELUCENT_KERNELS(Baseline)
#ifdef __x86_64__
RELUCENT_KERNELS(Avx2, [[gnu::target("avx2,fma")]])
#endif

}  // namespace

std::span<const EngineKernels> engineKernels() {
#ifdef __x86_64__
  static const EngineKernels all[] = {
      {"baseline", windowBaseline, stepBaseline, correctBaseline, boundBaseline, updateBaseline,
       reciprocalBaseline},
      {"AVX2, FMA", windowAvx2, stepAvx2, correctAvx2, boundAvx2, updateAvx2, reciprocalAvx2}};
  static const bool newer = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  return {all, newer ? 2u : 1u};
#else
  static const EngineKernels all[] = {{"baseline", windowBaseline, stepBaseline, correctBaseline,
                                       boundBaseline, updateBaseline, reciprocalBaseline}};
  return all;
#endif
}

}  // namespace relucent::engine
