// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "relucent/engine/packed_transport.h"
#include "relucent/inverse/windows.h"

namespace relucent::engine {

/// Inputs and outputs of a pass over T per camera pixel. Arrays over all camera pixels.
struct CameraArrays {
  const float* wanted = nullptr;  // 3: the target, minus black; and one value behind the last
  const float* weight = nullptr;  // 1
  const float* reach = nullptr;   // 1: the weight without its view's share
  const float* lit = nullptr;  // 3: the signal with all free projector pixels at full drive, by view's share
  const float* unmix = nullptr;  // 3x3, row-major
  float* unmixed = nullptr;      // 4: the weighted residual through `unmix`, and a zero
};

/// The squares of one patch, with the rows, groups and leaves of all of T. The leaves of a group, and those
/// of a row, differ in their columns.
struct PatchRows {
  std::span<const PackedSquare> squares;
  const PackedRow *row = nullptr, *rowEnd = nullptr;
  const PackedGroup* group = nullptr;
  const PackedLeaf* leaf = nullptr;
};

/// Floats per column in a pass over T, and in one that only sums.
inline constexpr std::size_t stepColumn = 8, sumColumn = 4;

/// A value beyond the projector's range by less than this, half a code of 8 bits, is not visibly clipped.
inline constexpr float visibleCut = 0.002f;

/// The inner loops of the engine, for one instruction set. They differ only in rounding.
struct EngineKernels {
  const char* instructions;
  /// One tile of the windows: values[c * pixels + i] = p of the tile's pixel i. `unmixed`: 4 a camera pixel.
  /// `clamped`: to 0 and 1.
  void (*window)(const inverse::WindowArrays& windows, std::size_t tile, const float* unmixed, bool clamped,
                 float* values);
  /// Product with T and its adjoint for one patch, reading its leaves once:
  ///   r = weight (wanted - T light),   sums += T^T r
  /// `columns`: 8 floats a column, light and adjoint sums together, because they are needed together:
  /// projector value 3, unused; sum 3, 0.
  void (*step)(const PatchRows& patch, const CameraArrays& camera, float* columns);
  /// The same, and `unmixed` is written.
  void (*correct)(const PatchRows& patch, const CameraArrays& camera, float* columns);
  /// sums += T^T lit, only for rows whose reach is `reach`. 4 floats a column: sum 3, 0.
  void (*bound)(const PatchRows& patch, const CameraArrays& camera, float reach, float* sums);
  /// p <- clamp(p + length c back); returns the number of visibly clipped values.
  std::size_t (*update)(float* p, const float* c, const float* back, float length, std::size_t count);
  /// c <- 1 / d,  d = share bound + partShare part, where that exceeds `least` and the rounding error of the
  /// difference; 0 elsewhere.
  void (*reciprocal)(float* c, const float* bound, const float* part, float share, float partShare,
                     float least, std::size_t count);
};

/// What this processor can run, the quickest last; the first runs on every processor of its kind.
std::span<const EngineKernels> engineKernels();

}  // namespace relucent::engine
