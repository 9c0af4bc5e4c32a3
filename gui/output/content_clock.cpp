// SPDX-License-Identifier: MIT
#include "output/content_clock.h"

#include <utility>

namespace relucent::gui {

ContentClock::ContentClock(Now now) : now_(std::move(now)), since_(now_()) {}

ContentTime ContentClock::time() const {
  if (paused_) return before_;
  return before_ + std::chrono::duration_cast<ContentTime>(now_() - since_);
}

void ContentClock::pause() {
  before_ = time();
  paused_ = true;
}

void ContentClock::resume() {
  if (!paused_) return;
  since_ = now_();
  paused_ = false;
}

}  // namespace relucent::gui
