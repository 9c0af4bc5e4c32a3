// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "relucent/rig/shot.h"

namespace relucent::rig {

/// Of a shot's samples, uncompressed: whole codes take a byte or two each, anything else four.
std::uint64_t plainBytes(const Shot& shot);

}  // namespace relucent::rig
