// SPDX-License-Identifier: MIT
#include "relucent/base/enum_names.h"

#include <fmt/ranges.h>

namespace relucent::detail {

void failUnknownName(ErrorKind error, std::string_view kind, std::string_view name,
                     const std::vector<std::string>& known) {
  throw Error(error,
              RELUCENT_ENGLISH_MESSAGE("name.unknown", "there is no {} '{}': there are {}")
                  .with(kind, name, fmt::to_string(fmt::join(known, ", "))),
              error == ErrorKind::format
                  ? RELUCENT_ENGLISH_MESSAGE("name.open-with-its-version",
                                             "open it with the version of Relucent that wrote it")
                  : RELUCENT_ENGLISH_MESSAGE("name.choose-one-of-these", "choose one of these"));
}

}  // namespace relucent::detail
