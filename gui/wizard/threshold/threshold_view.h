// SPDX-License-Identifier: MIT
#pragma once

#include "wizard/frame/page_view.h"
#include "wizard/threshold/threshold_page.h"

namespace relucent::gui {

PageView viewOf(ThresholdPage& model);

}  // namespace relucent::gui
