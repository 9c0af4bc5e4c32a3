// SPDX-License-Identifier: MIT
#pragma once

#include <QWidget>

#include "relucent/linearization/coverage.h"

namespace relucent::gui {

class CameraPage;

/// Where the picture is out of sight, and what helps; a simulated camera cannot be aimed.
QString missingText(const linearization::Coverage& coverage, bool isSimulated);

/// What was found out of camera and projector before anything is measured, and what helps against it.
QWidget* checksPart(CameraPage& model);

}  // namespace relucent::gui
