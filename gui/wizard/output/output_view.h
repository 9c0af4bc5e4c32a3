// SPDX-License-Identifier: MIT
#pragma once

#include "wizard/frame/page_view.h"
#include "wizard/output/output_page.h"

namespace relucent::gui {

PageView viewOf(OutputPage& model);

}  // namespace relucent::gui
