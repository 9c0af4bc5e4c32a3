// SPDX-License-Identifier: MIT
#pragma once

#include <QColor>
#include <QPointF>
#include <QRectF>
#include <QSizeF>
#include <QString>
#include <vector>

class QPainter;

namespace relucent::gui {

/// Size of a tag with a text of one or more lines, see drawTag().
QSizeF tagSize(const QString& text);
/// A tag's box at the first of `places`, its upper left corners, that does not overlap the areas to keep
/// free; else at the first of all. Contract: `places` is not empty.
QRectF tagBox(QSizeF size, const std::vector<QPointF>& places, const std::vector<QRectF>& kept);
/// Draws a small dark box with text over a picture.
void drawTag(QPainter& painter, QPointF topLeft, const QString& text, const QColor& colour,
             bool rightAligned = false);

}  // namespace relucent::gui
