// SPDX-License-Identifier: MIT
#pragma once

#include <QIcon>
#include <QPainter>

namespace relucent::gui {

/// Files of resources/icons/controls: line drawings in a box of 24, stroke 1.6 with round ends, never filled,
/// without letters.
enum class Icon {
  tick,
  lock,
  stale,
  failed,
  back,
  next,
  play,
  pause,
  save,
  stop,
  retry,
  folder,
  plus,
  moon,
  settings,
  help,
  projector,
  camera,
  disk,
  sun,
  information,
  warning,
  clock,
  picture,
  pulse,
  fit,
  actualSize,
  pick,
  monitor,
  house,
  black,
  compare,
  power,
  film,
  up,
  down,
  remove,
  report,
  drift
};

/// Draws it into a square. The colour is that of the text beside it.
void drawIcon(QPainter& painter, Icon icon, const QRectF& square, const QColor& colour);
/// The icon of a button: those that point back or forward are mirrored in right-to-left languages. Sharp at
/// any scale.
QIcon iconOf(Icon icon, const QColor& colour);
/// A picture file of the icon, for style sheets; it exists as long as the program runs.
QString iconFile(Icon icon, const QColor& colour, int side);
QPixmap pixmapOf(Icon icon, const QColor& colour, int side, double devicePixelRatio);

}  // namespace relucent::gui
