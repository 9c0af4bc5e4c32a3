// SPDX-License-Identifier: MIT
#pragma once

#include <QDeadlineTimer>
#include <QMutex>
#include <QWaitCondition>
#include <chrono>
#include <optional>

#include "relucent/sentinels/alarm.h"

namespace relucent::gui {

/// A question of the measuring thread to the user, and its answer.
class AlarmQuestion {
 public:
  sentinels::Answer wait() {
    QMutexLocker lock(&guard_);
    answer_.reset();
    while (!answer_ && !closed_) given_.wait(&guard_);
    return answer_.value_or(sentinels::Answer::keepAndStop);
  }
  /// Waits for that long; false: it was closed meanwhile.
  bool rest(std::chrono::milliseconds time) {
    QMutexLocker lock(&guard_);
    const QDeadlineTimer until(time);
    while (!closed_ && given_.wait(&guard_, until)) {
    }
    return !closed_;
  }
  /// Closed, it waits for nobody.
  void setClosed(bool closed) {
    QMutexLocker lock(&guard_);
    closed_ = closed;
    given_.wakeAll();
  }
  void give(sentinels::Answer answer) {
    QMutexLocker lock(&guard_);
    answer_ = answer;
    given_.wakeAll();
  }

 private:
  QMutex guard_;
  QWaitCondition given_;
  std::optional<sentinels::Answer> answer_;
  bool closed_ = false;
};

}  // namespace relucent::gui
