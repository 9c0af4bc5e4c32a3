// SPDX-License-Identifier: MIT
#pragma once

#include <QWidget>

namespace relucent::gui {

class PreviewPage;

/// How bright white is and where, what becomes of colours that the surface cannot show, how much may stay too
/// dark, and how far blacks are lifted.
QWidget* lightPart(PreviewPage& page);

}  // namespace relucent::gui
