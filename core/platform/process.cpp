// SPDX-License-Identifier: MIT
#include "relucent/platform/process.h"

#include <malloc.h>
#include <sys/resource.h>
#include <unistd.h>

namespace relucent::platform {
namespace {

rusage usageOfThisProgram() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage;
}

double secondsOf(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

}  // namespace

std::uint64_t processNumber() {
  return static_cast<std::uint64_t>(::getpid());
}

double processorSeconds() {
  const rusage usage = usageOfThisProgram();
  return secondsOf(usage.ru_utime) + secondsOf(usage.ru_stime);
}

std::uint64_t peakMemoryBytes() {
  const rusage usage = usageOfThisProgram();
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;  // Linux counts in kilobytes
}

void returnFreedMemory() {
  ::malloc_trim(0);
}

}  // namespace relucent::platform
