// SPDX-License-Identifier: MIT
#pragma once

#include <QJsonObject>
#include <QWidget>

namespace relucent::test {

/// Some of it is on the screen: it is shown, and neither scrolled away nor covered by its window's edge.
bool isInSight(const QWidget& widget);
/// Windows from the front to the back. Those of projectors, which have no widgets, are none.
QWidgetList windowsFromTheFront();
/// Texts, buttons, fields of all windows, as far as they are in sight.
QJsonObject allInSight();
/// How many pixels of it have this colour, as nearly as smoothed edges do.
int pixelsOf(QWidget& widget, const QColor& colour);
/// Share of its pixels that have the commonest colour: a view that holds no picture is nearly all of it.
double commonestShare(QWidget& widget);

}  // namespace relucent::test
