// SPDX-License-Identifier: MIT
#pragma once

#include <QString>
#include <cstdint>

namespace relucent::gui {

/// Free space for the user in a folder, or in its nearest existing ancestor.
std::uint64_t freeBytesAt(const QString& folder);

}  // namespace relucent::gui
