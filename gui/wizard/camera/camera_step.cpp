// SPDX-License-Identifier: MIT
#include "wizard/camera/camera_step.h"

#include "wizard/camera/camera_view.h"

namespace relucent::gui {

WizardStep cameraStep() {
  return stepOf<CameraPage>();
}

}  // namespace relucent::gui
