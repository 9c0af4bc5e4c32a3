// SPDX-License-Identifier: MIT
#pragma once

#include "wizard/acquire/acquire_page.h"
#include "wizard/frame/page_view.h"

namespace relucent::gui {

PageView viewOf(AcquirePage& model);

}  // namespace relucent::gui
