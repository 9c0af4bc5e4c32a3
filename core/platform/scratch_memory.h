// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

namespace relucent::platform {

/// Memory for what is large, zeros at first. Where the machine has plenty (memory_limits.h), it is plain
/// memory; else mapScratchFile(). Null if there is neither. To be given back by unmapScratch() with the same
/// size.
void* mapScratch(std::size_t bytes);
/// Memory that the system may move to the disk when it runs short: a file without a name in scratchFolder()
/// that is mapped and whose room is reserved; without room there, plain memory. The system writes it to the
/// disk even when it does not run short, which costs a fifth of the time of a computation that is limited by
/// memory.
void* mapScratchFile(std::size_t bytes);
void unmapScratch(void* memory, std::size_t bytes);

}  // namespace relucent::platform
