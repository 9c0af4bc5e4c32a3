// SPDX-License-Identifier: MIT
#include "output/overlay.h"

#include <QCoreApplication>
#include <QPainter>
#include <algorithm>

namespace relucent {
namespace {

/// The context of its texts for translators.
class Overlay {
  Q_DECLARE_TR_FUNCTIONS(Overlay)
};

}  // namespace

QStringList overlayLines(const OverlayState& state) {
  const PlayerStatistics& now = state.statistics;
  QStringList lines{Overlay::tr("%1 frames a second, %2 ms a frame, %3 of %4 late")
                        .arg(now.framesPerSecond, 0, 'f', 1)
                        .arg(1e3 * now.frameSeconds, 0, 'f', 1)
                        .arg(now.late)
                        .arg(now.frames),
                    state.compensated ? Overlay::tr("compensated, %1 steps, %2 % out of reach")
                                            .arg(now.steps)
                                            .arg(100.0 * now.clipped, 0, 'f', 1)
                                      : Overlay::tr("not compensated")};
  if (state.frozen) lines.append(Overlay::tr("frozen"));
  if (state.chart) lines.append(Overlay::tr("test chart: %1").arg(nameOf(*state.chart)));
  return lines;
}

void drawOverlay(QImage& picture, const QStringList& lines) {
  QPainter painter(&picture);
  QFont font = painter.font();
  font.setPixelSize(std::clamp(picture.height() / 40, 9, 48));
  painter.setFont(font);
  QString text = lines.join('\n');
  int margin = font.pixelSize() / 2;
  QRect place = painter.boundingRect(QRect(QPoint(margin, margin), picture.size()), 0, text);
  painter.fillRect(place.adjusted(-margin, -margin, margin, margin), Qt::black);
  painter.setPen(QColor(160, 160, 160));
  painter.drawText(place, 0, text);
}

}  // namespace relucent
