// SPDX-License-Identifier: MIT
#pragma once

#include "wizard/frame/wizard_step.h"

namespace relucent::gui {

WizardStep outputStep();

}  // namespace relucent::gui
