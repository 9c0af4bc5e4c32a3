// SPDX-License-Identifier: MIT
#pragma once

#include <QColor>
#include <QPointF>
#include <QRectF>
#include <QSizeF>
#include <QString>
#include <vector>

class QPainter;

namespace relucent {

/// Room that drawTag() takes for a text of one or more lines.
QSizeF tagSize(const QString& text);
/// A tag's box at the first of `places`, its upper left corners, that leaves free what is to be kept free; at
/// the first of all if none does. Contract: there is a place.
QRectF tagBox(QSizeF size, const std::vector<QPointF>& places, const std::vector<QRectF>& kept);
/// A small dark box with words, as it stands over pictures.
void drawTag(QPainter& painter, QPointF topLeft, const QString& text, const QColor& colour,
             bool rightAligned = false);

}  // namespace relucent
