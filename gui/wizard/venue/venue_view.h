// SPDX-License-Identifier: MIT
#pragma once

#include "wizard/frame/page_view.h"
#include "wizard/venue/venue_page.h"

namespace relucent::gui {

PageView viewOf(VenuePage& model);

}  // namespace relucent::gui
