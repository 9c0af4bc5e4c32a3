// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "transport/transport_matrix.h"

namespace relucent {

struct WindowSettings {
  int tile = 4;         // side of a tile of projector pixels
  int rows = 64;        // camera pixels of a window: those that see the tile strongest
  double ridge = 0.25;  // lambda as a share of the mean diagonal of G
};
std::vector<std::string> problems(const WindowSettings& settings);

/// The default inverse operator: for every tile of projector pixels a small regularised inverse over the
/// camera pixels that see it strongest; windows of neighbouring tiles overlap.
///   M_tile = T_J^T (G_WW + lambda I)^-1,  G = T T^T
class WindowInverse;  // see the .cpp's author: define here: apply(const Stack& cameraResidual) -> Stack
                      // projector

}  // namespace relucent
