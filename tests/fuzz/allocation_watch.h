// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

namespace relucent::fuzz {

/// The largest piece of memory that was asked for since the last forgetAllocations(): of C++'s operator new,
/// and under the address sanitizer of everything. What is asked for far beyond mostAtOnce is refused, so that
/// a computer with less memory survives it.
std::size_t largestAllocation();
void forgetAllocations();

}  // namespace relucent::fuzz
