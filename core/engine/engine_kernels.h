// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "engine/packed_transport.h"
#include "inverse/windows.h"

namespace relucent {

/// What a pass over T reads and writes for each camera pixel. Arrays over all camera pixels.
struct CameraArrays {
  const float* wanted = nullptr;  // 3: what should be seen, less black
  const float* weight = nullptr;  // 1
  const float* lit = nullptr;     // 3: what is seen while everything free is fully lit
  const float* unmix = nullptr;   // 3x3, row-major
  float* unmixed = nullptr;       // 4: the weighted residual through `unmix`, and a zero
};

/// The rows of one patch.
struct PatchRows {
  std::uint32_t rowBegin = 0, rowEnd = 0;
  const std::uint32_t* pixel = nullptr;
  const std::uint32_t* leafStart = nullptr;
  const PackedLeaf* leaf = nullptr;
  const float* mixing = nullptr;
};

/// Floats of a column in a pass over T.
inline constexpr std::size_t stepColumn = 8, correctColumn = 16;

/// A value beyond the projector's range by less than this, half a code of 8 bits, is not visibly cut.
inline constexpr float visibleCut = 0.002f;

/// The inner loops of the engine, for one instruction set. They differ in roundings only.
struct EngineKernels {
  const char* instructions;
  /// One tile of the windows: values[c * pixels + i] = p of the tile's pixel i. `unmixed`: 4 a camera pixel.
  /// `clamped`: to 0 and 1.
  void (*window)(const WindowArrays& windows, std::size_t tile, const float* unmixed, bool clamped,
                 float* values);
  /// A step's way through T and back for one patch, in one reading of its leaves:
  ///   r = weight (wanted - T light),   sums += T^T r
  /// `columns`: 8 floats a column, light there and sums back together, because they are needed together:
  /// projector value 3, 0; sum 3, 0.
  void (*step)(const PatchRows& rows, const CameraArrays& camera, float* columns);
  /// The same with 16 floats a column, the third four for the sums of T^T (weight lit), the fourth unused;
  /// and `unmixed` is written.
  void (*correct)(const PatchRows& rows, const CameraArrays& camera, float* columns);
  /// p <- clamp(p + length c back); returns how many values were visibly cut off.
  std::size_t (*update)(float* p, const float* c, const float* back, float length, std::size_t count);
  /// c <- free / c where c > least, 0 elsewhere.
  void (*reciprocal)(float* c, const float* free, float least, std::size_t count);
};

/// What this processor can run, the quickest last; the first runs on every processor of its kind.
std::span<const EngineKernels> engineKernels();

}  // namespace relucent
