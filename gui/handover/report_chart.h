// SPDX-License-Identifier: MIT
#pragma once

#include <QImage>
#include <QXmlStreamReader>

namespace relucent::gui {

/// Draws the chart at whose <svg> the reader is positioned, `dots` per unit of the chart, for paper. Supports
/// the elements that core/pipeline/report_charts.h writes: line, rect, circle, path of straight lines, text.
/// The reader is at </svg> afterwards.
QImage chartOf(QXmlStreamReader& xml, double dots);

}  // namespace relucent::gui
