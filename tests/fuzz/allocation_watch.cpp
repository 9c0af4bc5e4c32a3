// SPDX-License-Identifier: MIT
#include "fuzz/allocation_watch.h"

#include <atomic>
#include <cstdlib>
#include <new>

#if defined(__has_feature)
#if __has_feature(address_sanitizer)
#define RELUCENT_ADDRESS_SANITIZER
#endif
#endif
#if defined(__SANITIZE_ADDRESS__)
#define RELUCENT_ADDRESS_SANITIZER
#endif

#ifdef RELUCENT_ADDRESS_SANITIZER
// GCC brings the function without its header, sanitizer/allocator_interface.h.
extern "C" int __sanitizer_install_malloc_and_free_hooks(void (*malloc)(const volatile void*, std::size_t),
                                                         void (*free)(const volatile void*));
#endif

namespace relucent::fuzz {
namespace {

std::atomic<std::size_t> largest{0};

void note(std::size_t bytes) {
  std::size_t before = largest.load(std::memory_order_relaxed);
  while (bytes > before && !largest.compare_exchange_weak(before, bytes, std::memory_order_relaxed)) {
  }
}

}  // namespace

void forgetAllocations() {
#ifdef RELUCENT_ADDRESS_SANITIZER
  [[maybe_unused]] static const int installed = __sanitizer_install_malloc_and_free_hooks(
      [](const volatile void*, std::size_t bytes) { note(bytes); }, [](const volatile void*) {});
#endif
  largest = 0;
}

std::size_t largestAllocation() {
  return largest;
}

}  // namespace relucent::fuzz

#ifdef RELUCENT_ADDRESS_SANITIZER

extern "C" const char* __asan_default_options();
extern "C" const char* __asan_default_options() {
  return "max_allocation_size_mb=4096";
}

#elif !defined(__SANITIZE_THREAD__)

// NOLINTBEGIN(misc-new-delete-overloads): the others call these
void* operator new(std::size_t bytes) {
  constexpr std::size_t refused = std::size_t{4} << 30;
  relucent::fuzz::note(bytes);
  void* memory = bytes < refused ? std::malloc(bytes > 0 ? bytes : 1) : nullptr;
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}
void operator delete(void* memory) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}
// NOLINTEND(misc-new-delete-overloads)

#endif
