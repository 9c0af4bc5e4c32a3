// SPDX-License-Identifier: MIT
#include "relucent/platform/memory_peak.h"

#include <algorithm>

namespace relucent::platform {

MemoryPeak::MemoryPeak(std::chrono::milliseconds every) {
  look();
  watcher_ = std::thread([this, every] {
    std::unique_lock lock(mutex_);
    while (!ending_.wait_for(lock, every, [this] { return isEnding_; })) look();
  });
}

MemoryPeak::~MemoryPeak() {
  {
    std::lock_guard lock(mutex_);
    isEnding_ = true;
  }
  ending_.notify_one();
  watcher_.join();
}

MemoryUse MemoryPeak::value() {
  std::lock_guard lock(mutex_);
  look();
  return peak_;
}

void MemoryPeak::look() {
  const MemoryUse now = memoryUse();
  peak_ = {std::max(peak_.resident, now.resident), std::max(peak_.addressSpace, now.addressSpace),
           std::max(peak_.ofFiles, now.ofFiles)};
}

}  // namespace relucent::platform
