// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "wizard/frame/wizard_step.h"

namespace relucent::gui {

/// All steps in the order of the rail. Their list is `pages` in gui/wizard/CMakeLists.txt.
std::vector<WizardStep> wizardSteps();

}  // namespace relucent::gui
