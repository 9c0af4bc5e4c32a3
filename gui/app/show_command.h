// SPDX-License-Identifier: MIT
#pragma once

#include <QStringList>

namespace relucent {

/// `relucent show CALIBRATION ...`: plays a calibrated venue with nobody at it, until it is asked to end.
/// Exit status: 0 ended on request, 1 failed with one sentence, 2 wrong usage.
int runShowCommand(const QStringList& arguments);

}  // namespace relucent
