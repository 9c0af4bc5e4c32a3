// SPDX-License-Identifier: MIT
#include "content/content_address.h"

#include <array>
#include <utility>

#include "content/stream_address.h"

namespace relucent::gui {

ContentAddress addressOf(const QString& path) {
  using Kind = ContentAddress::Kind;
  constexpr std::array kinds{std::pair{"chart:", Kind::chart}, std::pair{"screen:", Kind::screen},
                             std::pair{"window:", Kind::window}, std::pair{"camera:", Kind::camera},
                             std::pair{"stream:", Kind::stream}};
  for (const auto& [prefix, kind] : kinds)
    if (path.startsWith(prefix)) return {kind, path.mid(path.indexOf(':') + 1)};
  return {Kind::file, path};
}

QString shownPath(const QString& path) {
  const ContentAddress address = addressOf(path);
  return address.kind == ContentAddress::Kind::stream ? shownStream(address.which) : path;
}

}  // namespace relucent::gui
