// SPDX-License-Identifier: MIT
#pragma once

#include <QSize>
#include <QStringList>

namespace relucent::gui {

/// Whether the arguments request the wizard: none at all, or the folder of one calibration.
bool asksForWizard(int argc, char** argv);

/// Whether a window of that size, with its decoration, fits the screen.
bool hasRoom(QSize window, QSize screen);

/// `relucent [CALIBRATION]`. Exit status: 0.
int runWizardCommand(int argc, char** argv);

}  // namespace relucent::gui
