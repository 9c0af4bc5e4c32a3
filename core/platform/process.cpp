// SPDX-License-Identifier: MIT
#include "relucent/platform/process.h"

#include <malloc.h>
#include <signal.h>
#include <sys/resource.h>
#include <unistd.h>

#include <limits>

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

bool askToEnd(std::uint64_t number) {
  // What is no single program's number means many of them to the system.
  if (number <= 1 || number > std::uint64_t{std::numeric_limits<pid_t>::max()}) return false;
  return ::kill(static_cast<pid_t>(number), SIGTERM) == 0;
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
