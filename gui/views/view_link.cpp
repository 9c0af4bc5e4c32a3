// SPDX-License-Identifier: MIT
#include "views/view_link.h"

#include <algorithm>

namespace relucent::gui {

void ViewLink::look(double zoom, QPointF centre) {
  zoom_ = std::clamp(zoom, 1.0, mostZoom_);
  double margin = 0.5 / zoom_;
  centre_ = {std::clamp(centre.x(), margin, 1.0 - margin), std::clamp(centre.y(), margin, 1.0 - margin)};
  Q_EMIT moved();
}

void ViewLink::setPick(std::optional<QPoint> pick) {
  pick_ = pick;
  Q_EMIT picked();
}

void ViewLink::reset() {
  look(1.0, {0.5, 0.5});
  setPick(std::nullopt);
}

}  // namespace relucent::gui
