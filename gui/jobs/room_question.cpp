// SPDX-License-Identifier: MIT
#include "jobs/room_question.h"

#include <QDeadlineTimer>
#include <utility>

namespace relucent::gui {
namespace {

// Short enough that work which is cancelled ends at once.
constexpr std::chrono::milliseconds betweenLooks{50};
constexpr int megabyte = 20;  // bits: less makes no difference to anybody

}  // namespace

calibration::RoomWaiter::Answer RoomQuestion::wait(const calibration::FullDisk& disk) {
  bool isNews = false;
  {
    QMutexLocker lock(&guard_);
    isNews =
        !waiting_ || waiting_->free >> megabyte != disk.free >> megabyte || waiting_->needed != disk.needed;
    waiting_ = disk;
  }
  if (isNews) Q_EMIT changed();
  QMutexLocker lock(&guard_);
  if (!goesOn_) told_.wait(&guard_, QDeadlineTimer(betweenLooks));
  return std::exchange(goesOn_, false) ? Answer::goOn : Answer::look;
}

void RoomQuestion::over() {
  {
    QMutexLocker lock(&guard_);
    waiting_.reset();
    goesOn_ = false;
  }
  Q_EMIT changed();
}

std::optional<calibration::FullDisk> RoomQuestion::waiting() const {
  QMutexLocker lock(&guard_);
  return waiting_;
}

void RoomQuestion::goOn() {
  QMutexLocker lock(&guard_);
  goesOn_ = waiting_.has_value();
  told_.wakeAll();
}

}  // namespace relucent::gui
