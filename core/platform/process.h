// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace relucent::platform {

/// A number that no other program on this computer has now.
std::uint64_t processNumber();

/// Asks another program to end, as the system does when somebody logs out. False: there is none of this
/// number that this one may ask.
bool askToEnd(std::uint64_t number);

/// Seconds of all cores together that this program has had so far, in the kernel too: unlike the wall
/// clock's, little longer where other programs run beside it.
double processorSeconds();

/// The most memory that this program has had resident so far.
std::uint64_t peakMemoryBytes();

/// Gives the system back what has been freed but is still kept for later, as C libraries do with many small
/// pieces.
void returnFreedMemory();

}  // namespace relucent::platform
