// SPDX-License-Identifier: MIT
#include "relucent/platform/scratch_memory.h"

#include <fcntl.h>
#include <sys/mman.h>

#include "relucent/platform/unnamed_file.h"

namespace relucent::platform {
namespace {

void* mapped(std::size_t bytes, int flags, int descriptor) {
  void* memory = ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, flags, descriptor, 0);
  return memory == MAP_FAILED ? nullptr : memory;
}

}  // namespace

void* mapScratch(std::size_t bytes) {
  const UnnamedFile file(scratchFolder());
  // Without its room reserved, a disk that fills would end the program at some access.
  if (!file.error() && !file.reserve(bytes))
    // The mapping outlives the descriptor.
    if (void* memory = mapped(bytes, MAP_SHARED, file.descriptor())) return memory;
  return mapped(bytes, MAP_PRIVATE | MAP_ANONYMOUS, -1);
}

void unmapScratch(void* memory, std::size_t bytes) {
  ::munmap(memory, bytes);
}

}  // namespace relucent::platform
