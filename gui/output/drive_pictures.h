// SPDX-License-Identifier: MIT
#pragma once

#include <QImage>
#include <vector>

#include "relucent/engine/drive_encoder.h"

namespace relucent::gui {

/// What the projectors are sent for linear drive, one picture each.
/// Shapes: a projector stack; one encoder a projector, of 8 bits.
std::vector<QImage> drivePictures(const ProjectorStack& linear, const Rasters& projectors,
                                  const std::vector<engine::DriveEncoder>& encoders);

}  // namespace relucent::gui
