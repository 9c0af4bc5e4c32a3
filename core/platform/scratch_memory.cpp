// SPDX-License-Identifier: MIT
#include "relucent/platform/scratch_memory.h"

#include <fcntl.h>
#include <sys/mman.h>

#include "relucent/platform/memory_limits.h"
#include "relucent/platform/unnamed_file.h"

namespace relucent::platform {
namespace {

void* mapped(std::size_t bytes, int flags, int descriptor) {
  void* memory = ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, flags, descriptor, 0);
  return memory == MAP_FAILED ? nullptr : memory;
}

void* plain(std::size_t bytes) {
  void* memory = mapped(bytes, MAP_PRIVATE | MAP_ANONYMOUS, -1);
  // Pages of two megabytes are made in a fraction of the time; where there are none, nothing is lost.
  if (memory != nullptr) static_cast<void>(::madvise(memory, bytes, MADV_HUGEPAGE));
  return memory;
}

}  // namespace

void* mapScratch(std::size_t bytes) {
  return isPlenty(bytes) ? plain(bytes) : mapScratchFile(bytes);
}

void* mapScratchFile(std::size_t bytes) {
  const UnnamedFile file(scratchFolder());
  // Without its room reserved, a disk that fills would end the program at some access.
  if (!file.error() && !file.reserve(bytes))
    // The mapping outlives the descriptor.
    if (void* memory = mapped(bytes, MAP_SHARED, file.descriptor())) return memory;
  return plain(bytes);
}

void unmapScratch(void* memory, std::size_t bytes) {
  ::munmap(memory, bytes);
}

}  // namespace relucent::platform
