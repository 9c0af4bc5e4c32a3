// SPDX-License-Identifier: MIT
#include "wizard/preview/preview_step.h"

#include "wizard/preview/preview_view.h"

namespace relucent::gui {

WizardStep previewStep() {
  return stepOf<PreviewPage>();
}

}  // namespace relucent::gui
