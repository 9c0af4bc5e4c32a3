// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "relucent/engine/packed_transport.h"
#include "relucent/engine/warp_tiles.h"
#include "relucent/inverse/windows.h"

namespace relucent::engine {

/// What a target is made from and written to. Arrays over all camera pixels; four floats of which three are
/// used are three channels and one that holds anything.
struct ContentTarget {
  std::array<float, 9> mixing{};  // row-major: target = mixing content + offset
  float offset = 0.0f;
  float unreachable = 0.0f;      // the weight of what cannot be reached
  float perWhite = 0.0f;         // 1 / white, by compensation::Objective::seen; otherwise 0
  float sharedLoss = 0.0f;       // compensation::sharedLoss()
  const float* known = nullptr;  // 8: black 3, and the weight of its view; flood 3, and the gain of white
  const float* unmix = nullptr;  // 3x3, row-major
  float* wanted = nullptr;       // 4: what is asked for; its weight
  float* held = nullptr;         // 4: the target minus black, between 0 and flood; weight for the windows
  float* unmixed = nullptr;      // 4: `held` through `unmix`; sensitivity, which the two weights differ by
  float* placed = nullptr;       // 4: the content, where asked for
};

/// Inputs and outputs of a pass over T per camera pixel. Arrays over all camera pixels.
struct CameraArrays {
  const float* wanted = nullptr;         // 4: as ContentTarget's `wanted`, or as `held` for the correction
  const float* lit = nullptr;            // 4: the signal with all free projector pixels at full drive
  float* unmixed = nullptr;              // 4: of ContentTarget; then the weighted residual through `unmix`
  const PackedMixings* unmix = nullptr;  // of every slice of rows
};

/// The squares of one patch, with the slices and leaves of all of T.
struct PatchRows {
  std::span<const PackedSquare> squares;
  const RowSlice* rowSlice = nullptr;
  std::size_t rowSlices = 0;
  const GroupSlice* groupSlice = nullptr;
  const LeavesAbreast* leaves = nullptr;
};

/// Floats per column of a patch in a pass over T, and per node of what comes back.
inline constexpr std::size_t columnFloats = 8, sumFloats = 4;

/// A value beyond the projector's range by less than this, half a code of 8 bits, is not visibly clipped.
inline constexpr float visibleCut = 0.002f;

/// The inner loops of the engine, for one instruction set. They differ only in rounding.
struct EngineKernels {
  const char* instructions;
  /// The content into one tile of camera pixels, and their targets. `part`: the tile's part of the content as
  /// linear light, 4 a pixel.
  void (*place)(const WarpTiles& warp, const WarpTiles::Tile& tile, const float* part,
                const ContentTarget& target);
  /// One tile of the windows: values[3 * i + c] = p of the tile's pixel i. `unmixed`: 4 a camera pixel.
  /// `clamped`: to 0 and 1.
  void (*window)(const inverse::WindowArrays& windows, std::size_t tile, const float* unmixed, bool clamped,
                 float* values);
  /// Product with T and its adjoint for one patch, reading its leaves once:
  ///   r = weight (wanted - T light),   sums += T^T r
  /// `columns`: 8 floats a column, light and adjoint sums together, so that what is read of the one brings
  /// the other into the cache: projector value 3, unused; sum 3, 0.
  void (*step)(const PatchRows& patch, const CameraArrays& camera, float* columns);
  /// The same; `unmixed` is written, and the fourth float of the adjoint sum is what C is made of,
  /// green of T^T weight lit.
  void (*correct)(const PatchRows& patch, const CameraArrays& camera, float* columns);
  /// p <- clamp(p + length c back); returns the number of visibly clipped values. `back`: 4 a pixel.
  std::size_t (*update)(float* p, const float* c, const float* back, float length, std::size_t pixels);
  /// c of StepPreconditioner's share and the fourth of `back`. `least`: of every pixel, infinite where it is
  /// not free.
  void (*precondition)(float* c, const float* back, const float* share, const float* least,
                       std::size_t pixels);
};

/// What this processor can run, the quickest last; the first runs on every processor of its kind.
std::span<const EngineKernels> engineKernels();

}  // namespace relucent::engine
