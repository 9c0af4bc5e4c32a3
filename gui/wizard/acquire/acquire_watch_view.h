// SPDX-License-Identifier: MIT
#pragma once

#include <QWidget>

#include "wizard/acquire/acquire_page.h"

namespace relucent::gui {

/// The room light over the measurement with the limits of its alarm, and when something was taken again.
QWidget* traceCard(AcquirePage& model);

/// What each watch says, and what was taken again.
QWidget* watchPart(AcquirePage& model);

}  // namespace relucent::gui
