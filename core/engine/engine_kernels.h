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

/// The inner loops of the engine, for one instruction set. They differ in roundings only.
struct EngineKernels {
  const char* instructions;
  /// One tile of the windows: values[c * pixels + i] = p of the tile's pixel i. `unmixed`: 4 a camera pixel.
  void (*window)(const WindowArrays& windows, std::size_t tile, const float* unmixed, float* values);
  /// A step's way through T and back for one patch, in one reading of its leaves. `light`: 4 a column, the
  /// last 0, projector values; `sums`: 4 a column, added to.
  ///   r = weight (wanted - T light),   sums += T^T r
  void (*step)(const PatchRows& rows, const CameraArrays& camera, const float* light, float* sums);
  /// The same with 8 sums a column, the second four of T^T (weight lit); and `unmixed` is written.
  void (*correct)(const PatchRows& rows, const CameraArrays& camera, const float* light, float* sums);
};

/// What this processor can run, the quickest last; the first runs on every processor of its kind.
std::span<const EngineKernels> engineKernels();

}  // namespace relucent
