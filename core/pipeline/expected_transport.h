// SPDX-License-Identifier: MIT
#pragma once

#include "relucent/transport/transport_matrix.h"

namespace relucent::pipeline {

/// T as it may be expected to be once it is measured in single pixels, from one that was measured in blocks.
/// Surfaces are smooth nearly everywhere, and pictures in focus:
///  1. Every camera pixel looks to the block that is brightest per projector pixel. Where in it follows from
///     the camera pixels around that look to the same block or to one beside it: a plane through the centres
///     of their blocks, by least squares, cut off at the block's border.
///  2. It sees as much of the projector as lies between it and its neighbours, at least a pixel: the plane's
///     slopes.
///  3. The light of the leaves that this area meets is in the part of them that it meets. All other light
///     stays where it is.
/// Law: T 1 is the same.  Shapes: `usable` per camera pixel; the others' rows stay as they are.
transport::TransportMatrix expectedTransport(const transport::TransportMatrix& transport,
                                             const CameraMask& usable);

}  // namespace relucent::pipeline
