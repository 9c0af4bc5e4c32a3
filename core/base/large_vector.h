// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <limits>
#include <memory>
#include <new>
#include <vector>

#include "relucent/platform/scratch_memory.h"

namespace relucent {

/// Memory from the heap for little, and for much, where the machine does not have plenty of it, from a mapped
/// file (platform/scratch_memory.h), so that what is gigabytes at full scale need not stay in memory as a
/// whole: the system keeps what is in use.
template <typename Value>
class LargeAllocator {
 public:
  using value_type = Value;
  /// From here on a file. Less is not worth one.
  static constexpr std::size_t large = std::size_t{32} << 20;

  LargeAllocator() = default;
  template <typename Other>
  LargeAllocator(const LargeAllocator<Other>&) {}  // NOLINT(google-explicit-constructor): as allocators are

  /// Throws: std::bad_alloc.
  Value* allocate(std::size_t count) {
    if (count > std::numeric_limits<std::size_t>::max() / sizeof(Value)) throw std::bad_array_new_length();
    const std::size_t bytes = count * sizeof(Value);
    if (bytes < large) return std::allocator<Value>().allocate(count);
    void* memory = platform::mapScratch(bytes);
    if (memory == nullptr) throw std::bad_alloc();
    return static_cast<Value*>(memory);
  }
  void deallocate(Value* memory, std::size_t count) {
    if (count * sizeof(Value) < large)
      std::allocator<Value>().deallocate(memory, count);
    else
      platform::unmapScratch(memory, count * sizeof(Value));
  }

  template <typename Other>
  bool operator==(const LargeAllocator<Other>&) const {
    return true;
  }
};

/// For what has an element for each leaf of T.
template <typename Value>
using LargeVector = std::vector<Value, LargeAllocator<Value>>;

}  // namespace relucent
