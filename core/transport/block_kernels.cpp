// SPDX-License-Identifier: MIT
// GCC's vector extensions, which Clang has too: four lanes are SSE on x86-64 and NEON on arm64. A block is
// too small for wider vectors to help. The version for newer processors is chosen when the program runs,
// because one package must be right on all of them; by hand, because the loader would ask for the choice
// (target_clones) before the sanitizers are ready.
#include "relucent/transport/block_kernels.h"

#include <cstring>

#include "relucent/transport/code_lanes.h"

namespace relucent::transport {
namespace {

using namespace detail;

RELUCENT_KERNEL Codes eightCodes(const std::int16_t* from) {
  Codes codes;
  std::memcpy(&codes, from, sizeof codes);
  return codes;
}

/// Four codes, then zeros.
RELUCENT_KERNEL Codes fourCodes(const std::int16_t* from) {
  std::int64_t codes;
  std::memcpy(&codes, from, sizeof codes);
  return reinterpret_cast<Codes>(Longs{codes, 0});
}

/// A block's codes times 65536, a vector for each camera channel; the fourth lane is of no meaning.
struct BlockLanes {
  Floats red, green, blue;
};

/// Reads the nine codes and nothing behind them.
RELUCENT_KERNEL BlockLanes lanesOf(const std::array<std::int16_t, 9>& code) {
  constexpr Codes zero{};
  Codes red = __builtin_shufflevector(zero, eightCodes(code.data()), 0, 8, 1, 9, 2, 10, 3, 11);
  Codes green = __builtin_shufflevector(zero, fourCodes(code.data() + 3), 0, 8, 1, 9, 2, 10, 3, 11);
  Codes blue = __builtin_shufflevector(zero, eightCodes(code.data() + 1), 4, 12, 5, 13, 6, 14, 7, 15);
  Floats late = floatsOf(blue);
  return {floatsOf(red), floatsOf(green), __builtin_shufflevector(late, late, 1, 2, 3, 3)};
}

/// Three codes times 65536; the fourth lane is zero. Reads nothing behind them.
RELUCENT_KERNEL Floats lanesOf(const std::array<std::int16_t, 3>& factor) {
  constexpr Codes zero{};
  std::int64_t codes = 0;
  std::memcpy(&codes, factor.data(), sizeof factor);
  return floatsOf(
      __builtin_shufflevector(zero, reinterpret_cast<Codes>(Longs{codes, 0}), 0, 8, 1, 9, 2, 10, 3, 11));
}

/// The three values of a column; `last` are those of the last one, behind which there is no fourth.
RELUCENT_KERNEL Floats valuesOf(std::size_t column, const BlockRows& rows, const float* x,
                                const float* last) {
  return load(column + 1 == rows.columns ? last : x + 3 * column);
}

RELUCENT_KERNEL float sumOfThree(Floats values) {
  return values[0] + values[1] + values[2];
}

RELUCENT_KERNEL void gatherRows(const BlockRows& rows, std::size_t begin, std::size_t end, const float* x,
                                float* y) {
  if (rows.columns == 0) return;
  // Behind the last column's three values there is nothing for a fourth lane.
  const std::size_t lastColumn = rows.columns - 1;
  const float last[4] = {x[3 * lastColumn], x[3 * lastColumn + 1], x[3 * lastColumn + 2], 0.0f};

  for (std::size_t row = begin; row < end; ++row) {
    Floats red{}, green{}, blue{};
    for (std::size_t entry = rows.start[row]; entry < rows.start[row + 1]; ++entry) {
      std::size_t column = rows.column[entry];
      Floats in = load(column == lastColumn ? last : x + 3 * column);
      BlockLanes block = lanesOf(rows.code[entry]);
      red += block.red * in;
      green += block.green * in;
      blue += block.blue * in;
    }
    float scale = lanesToCodes * rows.scale[row];
    y[3 * row] = scale * sumOfThree(red);
    y[3 * row + 1] = scale * sumOfThree(green);
    y[3 * row + 2] = scale * sumOfThree(blue);
  }
}

RELUCENT_KERNEL void scatterRows(const BlockRows& rows, std::size_t begin, std::size_t end, const float* y,
                                 ColumnSums& sums) {
  const auto* start = rows.start;
  const auto* column = rows.column;
  const auto* code = rows.code;
  const float* rowScale = rows.scale;
  for (std::size_t row = begin; row < end; ++row) {
    float scale = lanesToCodes * rowScale[row];
    float red = scale * y[3 * row], green = scale * y[3 * row + 1], blue = scale * y[3 * row + 2];
    if (red == 0.0f && green == 0.0f && blue == 0.0f) continue;
    const std::size_t rowEnd = start[row + 1];
    for (std::size_t entry = start[row]; entry < rowEnd; ++entry) {
      float* out = sums.at(column[entry]);
      BlockLanes block = lanesOf(code[entry]);
      // Added to the sum last: what a row before has stored there may still be on its way.
      Floats sum = load(out) + (block.red * red + block.green * green + block.blue * blue);
      std::memcpy(out, &sum, sizeof sum);
    }
  }
}

RELUCENT_KERNEL void gatherSharedRows(const BlockRows& rows, std::size_t begin, std::size_t end,
                                      const float* x, float* y) {
  if (rows.columns == 0) return;
  const float* lastValues = x + 3 * (rows.columns - 1);
  const float last[4] = {lastValues[0], lastValues[1], lastValues[2], 0.0f};
  for (std::size_t row = begin; row < end; ++row) {
    std::size_t entry = rows.start[row];
    const std::size_t rowEnd = rows.start[row + 1];
    float sums[3] = {0.0f, 0.0f, 0.0f};
    for (const ColumnKinds::Range& range : rows.kinds) {
      if (entry == rowEnd) break;
      if (rows.column[entry] >= range.end) continue;
      Floats light{};
      for (; entry < rowEnd && rows.column[entry] < range.end; ++entry)
        light += lanesOf(rows.factor[entry]) * valuesOf(rows.column[entry], rows, x, last);
      const float* mixing = rows.mixing + 9 * (row * rows.kindCount + range.kind);
      for (std::size_t c = 0; c < 3; ++c)
        sums[c] += mixing[3 * c] * light[0] + mixing[3 * c + 1] * light[1] + mixing[3 * c + 2] * light[2];
    }
    for (std::size_t c = 0; c < 3; ++c) y[3 * row + c] = lanesToCodes * sums[c];
  }
}

RELUCENT_KERNEL void scatterSharedRows(const BlockRows& rows, std::size_t begin, std::size_t end,
                                       const float* y, ColumnSums& sums) {
  for (std::size_t row = begin; row < end; ++row) {
    const float red = lanesToCodes * y[3 * row], green = lanesToCodes * y[3 * row + 1],
                blue = lanesToCodes * y[3 * row + 2];
    if (red == 0.0f && green == 0.0f && blue == 0.0f) continue;
    std::size_t entry = rows.start[row];
    const std::size_t rowEnd = rows.start[row + 1];
    for (const ColumnKinds::Range& range : rows.kinds) {
      if (entry == rowEnd) break;
      if (rows.column[entry] >= range.end) continue;
      const float* b = rows.mixing + 9 * (row * rows.kindCount + range.kind);
      const Floats light = {b[0] * red + b[3] * green + b[6] * blue, b[1] * red + b[4] * green + b[7] * blue,
                            b[2] * red + b[5] * green + b[8] * blue, 0.0f};
      for (; entry < rowEnd && rows.column[entry] < range.end; ++entry) {
        float* out = sums.at(rows.column[entry]);
        Floats sum = load(out) + lanesOf(rows.factor[entry]) * light;
        std::memcpy(out, &sum, sizeof sum);
      }
    }
  }
}

RELUCENT_KERNEL void gatherAny(const BlockRows& rows, std::size_t begin, std::size_t end, const float* x,
                               float* y) {
  if (rows.kindCount > 0)
    gatherSharedRows(rows, begin, end, x, y);
  else
    gatherRows(rows, begin, end, x, y);
}

RELUCENT_KERNEL void scatterAny(const BlockRows& rows, std::size_t begin, std::size_t end, const float* y,
                                ColumnSums& sums) {
  if (rows.kindCount > 0)
    scatterSharedRows(rows, begin, end, y, sums);
  else
    scatterRows(rows, begin, end, y, sums);
}

void gatherBaseline(const BlockRows& rows, std::size_t begin, std::size_t end, const float* x, float* y) {
  gatherAny(rows, begin, end, x, y);
}

void scatterBaseline(const BlockRows& rows, std::size_t begin, std::size_t end, const float* y,
                     ColumnSums& sums) {
  scatterAny(rows, begin, end, y, sums);
}

#ifdef __x86_64__
[[gnu::target("avx2,fma")]] void gatherAvx2(const BlockRows& rows, std::size_t begin, std::size_t end,
                                            const float* x, float* y) {
  gatherAny(rows, begin, end, x, y);
}

[[gnu::target("avx2,fma")]] void scatterAvx2(const BlockRows& rows, std::size_t begin, std::size_t end,
                                             const float* y, ColumnSums& sums) {
  scatterAny(rows, begin, end, y, sums);
}
#endif

}  // namespace

void ColumnSums::makeTile(Tile& tile) {
  tile = std::make_unique<float[]>(4 * tileColumns);
}

std::span<const BlockKernels> blockKernels() {
#ifdef __x86_64__
  static const BlockKernels all[] = {{"baseline", gatherBaseline, scatterBaseline},
                                     {"AVX2, FMA", gatherAvx2, scatterAvx2}};
  static const bool newer = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  return {all, newer ? 2u : 1u};
#else
  static const BlockKernels all[] = {{"baseline", gatherBaseline, scatterBaseline}};
  return all;
#endif
}

}  // namespace relucent::transport
