// SPDX-License-Identifier: MIT
#pragma once

#include <QString>

#include "compensation/method.h"

namespace relucent {

/// A way to compensate, in the user's language.
QString methodName(Method method);

}  // namespace relucent
