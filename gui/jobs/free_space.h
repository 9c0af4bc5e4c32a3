// SPDX-License-Identifier: MIT
#pragma once

#include <QString>
#include <cstdint>

namespace relucent {

/// What the user may still write where a folder is, or where it would be made: the nearest one above it that
/// exists counts.
std::uint64_t freeBytesAt(const QString& folder);

}  // namespace relucent
