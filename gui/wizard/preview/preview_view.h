// SPDX-License-Identifier: MIT
#pragma once

#include "wizard/frame/page_view.h"
#include "wizard/preview/preview_page.h"

namespace relucent::gui {

PageView viewOf(PreviewPage& model);

}  // namespace relucent::gui
