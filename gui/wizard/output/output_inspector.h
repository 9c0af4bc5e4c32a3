// SPDX-License-Identifier: MIT
#pragma once

#include <QWidget>

namespace relucent::gui {

class OutputPage;

/// Beside the output's pictures: the screen, what plays, what was proved, and how the venue is handed over.
QWidget* outputInspector(OutputPage& page);

}  // namespace relucent::gui
