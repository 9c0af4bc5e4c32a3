// SPDX-License-Identifier: MIT
#include "base/enum_names.h"

#include <fmt/ranges.h>

namespace relucent::detail {

void failUnknownName(ErrorKind error, std::string_view kind, std::string_view name,
                     const std::vector<std::string>& known) {
  throw Error(error, fmt::format("there is no {} '{}': there are {}", kind, name, fmt::join(known, ", ")),
              error == ErrorKind::format ? "open it with the version of Relucent that wrote it"
                                         : "choose one of these");
}

}  // namespace relucent::detail
