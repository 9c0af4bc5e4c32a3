// SPDX-License-Identifier: MIT
#pragma once

#include <QStringList>

namespace relucent {

/// Whether the arguments ask for the wizard: none at all, or the folder of one calibration.
bool asksForWizard(int argc, char** argv);

/// `relucent [CALIBRATION]`. Exit status: 0.
int runWizardCommand(int argc, char** argv);

}  // namespace relucent
