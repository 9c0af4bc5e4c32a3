// SPDX-License-Identifier: MIT
#pragma once

#include <QString>
#include <string_view>

namespace relucent {

/// A way to compensate, in the user's language. `name`: core's, see methodFromName().
QString methodName(std::string_view name);

}  // namespace relucent
