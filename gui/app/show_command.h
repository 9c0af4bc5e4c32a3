// SPDX-License-Identifier: MIT
#pragma once

#include <QStringList>

namespace relucent {

/// Whether the arguments ask for words or for the start at log-in: then no screen is needed.
bool asksForNoScreen(int argc, char** argv);

/// `relucent show CALIBRATION ...`: plays a calibrated venue with nobody at it, until it is asked to end.
/// Exit status: 0 ended on request, 1 failed with one sentence, 2 wrong usage.
int runShowCommand(const QStringList& arguments);

}  // namespace relucent
