// SPDX-License-Identifier: MIT
#pragma once

#include <QImage>

#include "relucent/image/image.h"

namespace relucent::gui {

/// Round what the projectors light, to lie over the floodlight image; and its share of the view.
struct LitOutline {
  QImage picture;
  double share = 0.0;
};
/// Null and nothing where nothing is lit. `flood`: linear.
LitOutline litOutline(const image::Image& flood);

}  // namespace relucent::gui
