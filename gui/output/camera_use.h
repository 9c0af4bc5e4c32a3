// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>

#include "relucent/base/progress.h"

namespace relucent::gui {

/// A camera that several have need of, one at a time: who looks on lets go of it for who measures.
class CameraUse {
 public:
  /// Contract: nobody has it.
  void begin() {
    const std::lock_guard lock(guard_);
    isUsed_ = true;
  }
  void end() {
    {
      const std::lock_guard lock(guard_);
      isUsed_ = false;
    }
    changed_.notify_all();
  }
  /// Waits until nobody has it. Throws: Cancelled.
  void awaitFree(const Progress& progress) {
    constexpr std::chrono::milliseconds betweenLooks{50};
    std::unique_lock lock(guard_);
    while (!changed_.wait_for(lock, betweenLooks, [this] { return !isUsed_; })) progress.checkpoint();
  }

 private:
  std::mutex guard_;
  std::condition_variable changed_;
  bool isUsed_ = false;
};

}  // namespace relucent::gui
