// SPDX-License-Identifier: MIT
#include "output/overlay.h"

#include <QCoreApplication>
#include <QLocale>
#include <QPainter>
#include <algorithm>

namespace relucent::gui {
namespace {

/// The context of its texts for translators.
class Overlay {
  Q_DECLARE_TR_FUNCTIONS(Overlay)
};

}  // namespace

QStringList overlayLines(const OverlayState& state) {
  const PlayerStatistics& now = state.statistics;
  auto number = [](double value) { return QLocale().toString(value, 'f', 1); };
  QStringList lines{
      now.framesPerSecond > 0.0 ? Overlay::tr("%1 frames a second, %2 ms a frame, %3 of %4 late")
                                      .arg(number(now.framesPerSecond), number(1e3 * now.frameSeconds))
                                      .arg(now.late)
                                      .arg(now.frames)
                                : Overlay::tr("still picture"),
      state.compensated && now.perfected ? Overlay::tr("perfected by photographs")
      : state.compensated ? Overlay::tr("compensated, %n step(s), %1 % out of reach", nullptr, now.steps)
                                .arg(number(100.0 * now.clipped))
                          : Overlay::tr("not compensated")};
  if (now.viewerSeconds > 0.0)
    lines.append(Overlay::tr("follows a viewer within %1 ms").arg(number(1e3 * now.viewerSeconds)));
  if (now.liveSeconds > 0.0)
    lines.append(Overlay::tr("live picture within %1 ms of its arrival").arg(number(1e3 * now.liveSeconds)));
  if (state.frozen) lines.append(Overlay::tr("frozen"));
  if (state.chart) lines.append(Overlay::tr("test chart: %1").arg(testChartName(*state.chart)));
  return lines;
}

QImage overlayPicture(QSize size, const QStringList& lines) {
  QFont font;
  font.setPixelSize(std::clamp(size.height() / 40, 9, 48));
  const int margin = font.pixelSize() / 2;
  // At the left in every language: what is projected is not mirrored.
  constexpr int side = Qt::AlignAbsolute | Qt::AlignLeft;
  const QString text = lines.join('\n');
  const QRect place = QFontMetrics(font).boundingRect(QRect(QPoint(margin, margin), size), side, text);
  QImage picture(QSize(place.right() + 1 + margin, place.bottom() + 1 + margin).boundedTo(size),
                 QImage::Format_RGBX8888);
  picture.fill(Qt::black);
  QPainter painter(&picture);
  painter.setFont(font);
  painter.setPen(QColor(160, 160, 160));
  painter.drawText(place, side, text);
  return picture;
}

}  // namespace relucent::gui
