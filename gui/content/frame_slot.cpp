// SPDX-License-Identifier: MIT
#include "content/frame_slot.h"

#include <QDeadlineTimer>
#include <QMutexLocker>

#include "content/still_image.h"

namespace relucent::gui {

void FrameSlot::put(const QVideoFrame& frame) {
  // The end of a film is an empty frame; its last picture stays.
  if (!frame.isValid()) return;
  QMutexLocker lock(&guard_);
  newest_ = {frame, nextFrameNumber(), newest_.jpeg, std::chrono::steady_clock::now()};
  came_.wakeAll();
}

void FrameSlot::fail(const QString& reason) {
  QMutexLocker lock(&guard_);
  failure_ = reason;
  came_.wakeAll();
}

bool FrameSlot::waitForFirst(int milliseconds) {
  QMutexLocker lock(&guard_);
  QDeadlineTimer until(milliseconds);
  while (newest_.number == 0 && failure_.isEmpty() && came_.wait(&guard_, until)) {
  }
  return newest_.number != 0;
}

void FrameSlot::markAsJpeg() {
  QMutexLocker lock(&guard_);
  newest_.jpeg = true;
}

QString FrameSlot::failure() const {
  QMutexLocker lock(&guard_);
  return failure_;
}

FrameSlot::Newest FrameSlot::newest() const {
  QMutexLocker lock(&guard_);
  return newest_;
}

}  // namespace relucent::gui
