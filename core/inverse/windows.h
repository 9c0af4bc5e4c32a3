// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "relucent/base/progress.h"
#include "relucent/transport/transport_matrix.h"

namespace relucent::inverse {

struct WindowSettings {
  int tile = 4;        // side of a tile of projector pixels, 4 or 8
  int rows = 48;       // camera pixels of a window: those that see the tile strongest
  double ridge = 0.4;  // lambda as a share of the mean diagonal of G
};
std::vector<Message> problems(const WindowSettings& settings);

/// The arrays of a WindowInverse, without owning them: for callers that apply it with loops of their own.
/// Valid as long as the WindowInverse.
struct WindowArrays {
  const Rasters* tiles = nullptr;        // their grid on each projector
  int tile = 0;                          // side of a tile in pixels
  const float* unmix = nullptr;          // 3x3 a camera pixel, row-major
  const std::size_t* start = nullptr;    // window rows of tile t: [start[t], start[t + 1])
  const std::uint32_t* row = nullptr;    // camera pixel of a window row
  const std::int16_t* weight = nullptr;  // [window row][channel][pixel of the tile]
  const float* scale = nullptr;          // [tile][channel]: weight = scale * code
};

/// The default inverse operator: for every tile of projector pixels a small regularised inverse over the
/// camera pixels that receive most of its light; the windows of neighbouring tiles overlap.
///   p_tile = M_tile U r,   M_tile = T_J^T (G + lambda N)^-1,   G = T_W T_W^T
/// U unmixes the colours of every camera pixel by its own 3x3 mixing, after which each colour channel is a
/// scalar system of its own. N is the camera's noise after U. M is the best linear estimate under an unknown
/// mean: the flood image T 1 gives white. Storage: 16-bit fixed point, 6 bytes for each projector pixel and
/// row of its window. Immutable; made by computeWindows().  Source: core/inverse/README.md.
class WindowInverse {
 public:
  WindowInverse() = default;

  const Rasters& cameras() const { return cameras_; }
  const Rasters& projectors() const { return projectors_; }
  std::size_t bytes() const;

  /// p = M r, not clamped. Same bits for every number of threads.
  /// Shapes: 3 * cameras().count() -> 3 * projectors().count().
  /// Units: camera signal per second -> linear drive. Projector pixels that no camera pixel sees stay 0.
  ProjectorStack apply(const CameraStack& cameraResidual) const;

  WindowArrays view() const;

  /// The whole operator for other programs, unmixing included: rows = projector pixels, columns = camera
  /// pixels.
  transport::BlockSparse matrix() const;

  bool operator==(const WindowInverse&) const = default;

 private:
  friend class PreparedWindows;
  friend class WindowBlocks;
  friend class WindowBuilder;
  friend class WindowFile;

  static Rasters gridOf(const Rasters& projectors, int tile);

  Rasters cameras_;
  Rasters projectors_;
  Rasters tiles_;
  int tile_ = 0;
  std::vector<float> unmix_;            // 3x3 a camera pixel, row-major
  std::vector<std::size_t> tileStart_;  // window rows of tile t: [tileStart_[t], tileStart_[t + 1])
  std::vector<std::uint32_t> row_;      // camera pixel of a window row
  LargeVector<std::int16_t> weight_;    // [window row][channel][pixel of the tile]
  std::vector<float> scale_;            // [tile][channel]: weight = scale * code
};

/// Computes all windows.
///  1. U_i = the regularised inverse of camera pixel i's 3x3 mixing B_i (sum over its row of T).
///  2. Every row's near field: the leaves, of whatever level, that are bright per projector pixel.
///  3. For every tile the `rows` camera pixels whose near fields have most light in it.
///  4. G over the pixels round the tile, beyond them over areas of 8x8; Cholesky.
///  5. M = T_J^T (G + lambda N)^-1, with the smallest change that makes the inverse of the flood image white.
/// `usable`: per camera pixel, 0 where it is unreliable. A thresholded T should have been rescaled to the
/// flood image before.  Source: core/inverse/README.md.
/// Throws: Error{numerics} if a G is not positive definite; Cancelled.
WindowInverse computeWindows(const transport::TransportMatrix& transport, const CameraMask& usable,
                             const WindowSettings& settings, Progress& progress);

}  // namespace relucent::inverse
