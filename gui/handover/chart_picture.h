// SPDX-License-Identifier: MIT
#pragma once

#include <QImage>
#include <QXmlStreamReader>

namespace relucent::gui {

/// Draws the chart at whose <svg> the reader is positioned, `dots` per unit of the chart, for paper. The
/// reader is at </svg> afterwards.
QImage chartPicture(QXmlStreamReader& xml, double dots);

}  // namespace relucent::gui
