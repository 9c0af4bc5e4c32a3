// SPDX-License-Identifier: MIT
#pragma once

#include "wizard/camera/camera_page.h"
#include "wizard/frame/page_view.h"

namespace relucent::gui {

PageView viewOf(CameraPage& model);

}  // namespace relucent::gui
