// SPDX-License-Identifier: MIT
#pragma once

#include <QColor>
#include <QPointF>
#include <QSizeF>
#include <QString>

class QPainter;

namespace relucent {

/// Room that drawTag() takes for a text of one or more lines.
QSizeF tagSize(const QString& text);
/// A small dark box with words, as it stands over pictures.
void drawTag(QPainter& painter, QPointF topLeft, const QString& text, const QColor& colour,
             bool rightAligned = false);

}  // namespace relucent
