// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "relucent/devices/listed_camera.h"

namespace relucent::gui {

/// What one camera has over another; or that it is alone, or nothing.
enum class CameraMerit { alone, bits, exposures, pixels, none };

/// Cameras that can be used before others; then more bits, which tell faint light apart; then a range of
/// exposures that is at least twice as wide; then more pixels. Equal ones stay in their order.
void rank(std::vector<devices::ListedCamera>& cameras);

/// By what `better` comes before `other`. Both can be used.
CameraMerit meritOver(const devices::ListedCamera& better, const devices::ListedCamera& other);
/// Of ranked cameras: what the first one has over the next, or what another lacks beside the first.
/// Contract: that camera can be used.
CameraMerit meritOf(const std::vector<devices::ListedCamera>& ranked, std::size_t camera);

}  // namespace relucent::gui
