// SPDX-License-Identifier: MIT
#include "relucent/platform/process.h"

#include <malloc.h>
#include <sys/resource.h>
#include <unistd.h>

namespace relucent::platform {

std::uint64_t processNumber() {
  return static_cast<std::uint64_t>(::getpid());
}

std::uint64_t peakMemoryBytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;  // Linux counts in kilobytes
}

void returnFreedMemory() {
  ::malloc_trim(0);
}

}  // namespace relucent::platform
