// SPDX-License-Identifier: MIT
#pragma once

#include "wizard/frame/page_view.h"
#include "wizard/linearize/linearize_page.h"

namespace relucent::gui {

PageView viewOf(LinearizePage& model);

}  // namespace relucent::gui
