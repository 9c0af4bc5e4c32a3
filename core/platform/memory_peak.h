// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>

#include "relucent/platform/memory_limits.h"

namespace relucent::platform {

/// The most memory that this program has taken since this was made, looked at so often, each figure by
/// itself.
class MemoryPeak {
 public:
  explicit MemoryPeak(std::chrono::milliseconds every = std::chrono::milliseconds(20));
  ~MemoryPeak();
  MemoryPeak(const MemoryPeak&) = delete;
  MemoryPeak& operator=(const MemoryPeak&) = delete;

  MemoryUse value();

 private:
  void look();

  std::mutex mutex_;
  std::condition_variable ending_;
  bool isEnding_ = false;
  MemoryUse peak_;
  std::thread watcher_;
};

}  // namespace relucent::platform
