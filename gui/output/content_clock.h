// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <functional>

#include "content/content_source.h"

namespace relucent::gui {

/// Content time, one for all projectors: runs with the steady clock and stops while paused.
class ContentClock {
 public:
  using Now = std::function<std::chrono::steady_clock::time_point()>;
  explicit ContentClock(Now now = std::chrono::steady_clock::now);

  ContentTime time() const;
  /// Of the steady clock, paused or not.
  std::chrono::steady_clock::time_point now() const { return now_(); }
  bool isPaused() const { return paused_; }
  void pause();
  void resume();

 private:
  Now now_;
  std::chrono::steady_clock::time_point since_;
  ContentTime before_{0};  // content time at that moment
  bool paused_ = false;
};

}  // namespace relucent::gui
