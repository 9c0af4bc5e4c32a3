// SPDX-License-Identifier: MIT
#include "content/content_address.h"

#include <array>
#include <utility>

namespace relucent::gui {

ContentAddress addressOf(const QString& path) {
  using Kind = ContentAddress::Kind;
  constexpr std::array kinds{std::pair{"chart:", Kind::chart}, std::pair{"screen:", Kind::screen},
                             std::pair{"window:", Kind::window}, std::pair{"camera:", Kind::camera}};
  for (const auto& [prefix, kind] : kinds)
    if (path.startsWith(prefix)) return {kind, path.mid(path.indexOf(':') + 1)};
  return {Kind::file, path};
}

}  // namespace relucent::gui
