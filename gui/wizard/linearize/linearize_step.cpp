// SPDX-License-Identifier: MIT
#include "wizard/linearize/linearize_step.h"

#include "wizard/linearize/linearize_view.h"

namespace relucent::gui {

WizardStep linearizeStep() {
  return stepOf<LinearizePage>();
}

}  // namespace relucent::gui
