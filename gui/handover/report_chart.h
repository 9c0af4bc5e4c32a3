// SPDX-License-Identifier: MIT
#pragma once

#include <QImage>
#include <QXmlStreamReader>

namespace relucent {

/// The chart at whose <svg> the reader stands, drawn for paper, dots a unit of the chart's own. Knows the
/// elements that core/pipeline/report_charts.h writes: line, rect, circle, path of straight lines, text.
/// The reader stands at </svg> afterwards.
QImage chartOf(QXmlStreamReader& xml, double dots);

}  // namespace relucent
