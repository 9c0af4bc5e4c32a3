// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <memory>
#include <utility>

#include "relucent/sentinels/observer.h"
#include "wizard/acquire/alarm_question.h"

namespace relucent::gui {

/// Looks on for another, and tries again by itself what may have passed when it is photographed next: a door
/// stood open, somebody went through the light. Three times at one place, then somebody has to be asked; and
/// only about what was photographed now: what is read from a log may have been accepted, and trying again
/// would throw away all that followed. On the measuring thread.
class RetryingObserver : public sentinels::AcquisitionObserver {
 public:
  /// `rest`: before each try.
  RetryingObserver(sentinels::AcquisitionObserver& other, std::shared_ptr<AlarmQuestion> question,
                   std::chrono::milliseconds rest)
      : other_(other), question_(std::move(question)), rest_(rest) {}

  void checked(const sentinels::Reading& reading) override {
    isNew_ = reading.alarm.has_value();
    if (!isNew_) tries_ = 0;
    other_.checked(reading);
  }
  void takenAgain(const sentinels::Retake& retake) override { other_.takenAgain(retake); }
  void grew(const std::vector<int>& levels, int through) override { other_.grew(levels, through); }
  bool wantsDrafts() const override { return other_.wantsDrafts(); }
  void drafted(const transport::Draft& draft) override { other_.drafted(draft); }

  /// After the rest; false: it is for somebody to decide.
  bool triesAgain(sentinels::AlarmKind kind) {
    constexpr int most = 3;
    const bool mayPass =
        kind == sentinels::AlarmKind::ambientChanged || kind == sentinels::AlarmKind::localChange;
    if (!mayPass || !std::exchange(isNew_, false) || tries_ == most) {
      tries_ = 0;
      return false;
    }
    ++tries_;
    return question_->rest(rest_);
  }

 private:
  sentinels::AcquisitionObserver& other_;
  std::shared_ptr<AlarmQuestion> question_;
  std::chrono::milliseconds rest_;
  int tries_ = 0;
  bool isNew_ = false;  // the last check that was told had an alarm
};

}  // namespace relucent::gui
