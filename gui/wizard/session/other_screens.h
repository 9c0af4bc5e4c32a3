// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "relucent/pipeline/rig_settings.h"

namespace relucent::gui {

/// The screens of the desktop that may light up to find out which one a camera sees instead of `projector`'s,
/// each as the projector's settings would be if it were chosen.
/// Never one that the operator works on: the desktop's first, those on which a window of this program stands,
/// and any that shows a part of one of these. The patterns would hide the wizard and its way out, and shine
/// into somebody's face; a camera that sees such a screen is told to see none. Where the operator's screen is
/// the only one, it is the projector's, which the operator was warned of when choosing it.
/// On the interface's thread.
std::vector<pipeline::ScreenRigSettings> otherScreens(const pipeline::ScreenRigSettings& projector);

/// The same for a worker's thread. Throws: Cancelled if that is asked to end meanwhile.
std::vector<pipeline::ScreenRigSettings> askForOtherScreens(const pipeline::ScreenRigSettings& projector);

}  // namespace relucent::gui
