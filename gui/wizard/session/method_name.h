// SPDX-License-Identifier: MIT
#pragma once

#include <QString>

#include "relucent/compensation/method.h"

namespace relucent::gui {

/// A way to compensate, in the user's language.
QString methodName(compensation::Method method);

}  // namespace relucent::gui
