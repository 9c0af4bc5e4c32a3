// SPDX-License-Identifier: MIT
#include "wizard/threshold/threshold_step.h"

#include "wizard/threshold/threshold_view.h"

namespace relucent::gui {

WizardStep thresholdStep() {
  return stepOf<ThresholdPage>();
}

}  // namespace relucent::gui
