// SPDX-License-Identifier: MIT
#include "relucent/base/require.h"

namespace relucent::detail {

void failRequire(const std::source_location& location, const std::string& message) {
  throw std::logic_error(
      fmt::format("{}:{}: {}: {}", location.file_name(), location.line(), location.function_name(), message));
}

}  // namespace relucent::detail
