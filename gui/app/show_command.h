// SPDX-License-Identifier: MIT
#pragma once

#include <QStringList>

namespace relucent::gui {

/// Whether the arguments request only a text or the start at log-in, which need no screen.
bool asksForNoScreen(int argc, char** argv);

/// `relucent show CALIBRATION ...`: plays a calibrated venue unattended, until it is asked to end. Exit
/// status: 0 ended on request, 1 failed with one sentence, 2 wrong usage.
int runShowCommand(const QStringList& arguments);

}  // namespace relucent::gui
