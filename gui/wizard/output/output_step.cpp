// SPDX-License-Identifier: MIT
#include "wizard/output/output_step.h"

#include "wizard/output/output_view.h"

namespace relucent::gui {

WizardStep outputStep() {
  return stepOf<OutputPage>();
}

}  // namespace relucent::gui
