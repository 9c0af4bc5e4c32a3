// SPDX-License-Identifier: MIT
#pragma once

#include "wizard/cluster/cluster_page.h"
#include "wizard/frame/page_view.h"

namespace relucent::gui {

PageView viewOf(ClusterPage& model);

}  // namespace relucent::gui
