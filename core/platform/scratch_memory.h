// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

namespace relucent::platform {

/// Memory that the system may move to the disk when it runs short: a file without a name in scratchFolder()
/// that is mapped and whose room is reserved; without room there, plain memory. Zeros at first. Null if there
/// is neither. To be given back by unmapScratch() with the same size.
void* mapScratch(std::size_t bytes);
void unmapScratch(void* memory, std::size_t bytes);

}  // namespace relucent::platform
