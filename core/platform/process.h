// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace relucent::platform {

/// A number that no other program on this computer has now.
std::uint64_t processNumber();

/// The most memory that this program has had resident so far.
std::uint64_t peakMemoryBytes();

}  // namespace relucent::platform
