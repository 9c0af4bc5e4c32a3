// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>

#include "relucent/transport/transport_matrix.h"

namespace relucent::transport {

/// Where in the camera's former picture (pixels; the middle of pixel x is x) lies what one of its pixels sees
/// now. `place`: of that pixel in its camera.
using FormerPlace = std::function<Eigen::Vector2d(std::size_t camera, const Pixel& place)>;

struct MovedRows {
  TransportMatrix transport;  // of the cameras as they look now, without groups
  CameraMask unknown;         // per camera pixel: what it sees was not in the picture; its row is empty
};

/// T of cameras that look elsewhere than they did: every row is interpolated between those of the 4x4 pixels
/// around its former place,
///   T'_i = sum_n w_n T_n,      w: Catmull and Rom's cubics,
/// which add no spread of their own where rows drift evenly over the picture. What is finer than the camera's
/// pixels cannot be interpolated: where they are about as large as the projector's, or the surface's pattern
/// as fine as they, rows have to be measured instead.
/// Source: Keys, "Cubic convolution interpolation for digital image processing", 1981.
MovedRows movedRows(const TransportMatrix& transport, const FormerPlace& former);

}  // namespace relucent::transport
