// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "output/screen_identity.h"

namespace relucent::gui {

class Session;

/// Where the projectors of the open calibration shine, one screen each: the calibration's own; simulated
/// projectors borrow those that nobody works at. Fewer than projectors: the others' are not there.
std::vector<ScreenIdentity> projectorScreens(const Session& session);

}  // namespace relucent::gui
