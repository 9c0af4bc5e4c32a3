// SPDX-License-Identifier: MIT
#include "base/stopwatch.h"

#include <sys/resource.h>

namespace relucent {

std::uint64_t peakMemoryBytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;  // Linux counts in kilobytes
}

}  // namespace relucent
