// SPDX-License-Identifier: MIT
#include "wizard/acquire/lit_outline.h"

#include <QPainter>

#include "relucent/reduction/lit_part.h"
#include "theme/theme.h"

namespace relucent::gui {

LitOutline litOutline(const image::Image& flood) {
  const reduction::LitPart part = reduction::litPart(flood);
  if (part.size.empty()) return {};
  // Finer than the photograph, so that dashes are dashes.
  constexpr int fine = 4;
  LitOutline outline;
  outline.picture =
      QImage(flood.size().width * fine, flood.size().height * fine, QImage::Format_ARGB32_Premultiplied);
  outline.picture.fill(Qt::transparent);
  QPainter painter(&outline.picture);
  const QRectF lit(part.begin.x * fine, part.begin.y * fine, part.size.width * fine, part.size.height * fine);
  const double width = std::max(2.0, outline.picture.width() / 400.0);
  painter.setPen(QPen(colours(Look::dark).picture, 2.0 * width));
  painter.drawRect(lit.adjusted(width, width, -width, -width));
  painter.setPen(QPen(colours(Look::dark).accent, width, Qt::DashLine));
  painter.drawRect(lit.adjusted(width, width, -width, -width));
  outline.share = static_cast<double>(part.size.count()) / static_cast<double>(flood.size().count());
  return outline;
}

}  // namespace relucent::gui
