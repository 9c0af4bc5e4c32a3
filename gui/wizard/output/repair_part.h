// SPDX-License-Identifier: MIT
#pragma once

#include <QWidget>

namespace relucent::gui {

class OutputPage;

/// For the inspector of Output: what the last repair found and came to, that what is used was repaired, and
/// the buttons.
QWidget* repairPart(OutputPage& page);

}  // namespace relucent::gui
