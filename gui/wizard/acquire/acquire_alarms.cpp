// SPDX-License-Identifier: MIT
// What the page of acquisition asks when a sentinel raises an alarm, and what it does with the answer.
#include <fmt/format.h>

#include "text/message_text.h"
#include "views/number_text.h"
#include "wizard/acquire/acquire_page.h"

namespace relucent::gui {
namespace {

/// Of a camera that looks where it looked: whether it had moved is not known of every alarm.
QString putRightHeading(sentinels::AlarmKind kind) {
  return kind == sentinels::AlarmKind::moved ? AcquirePage::tr("The camera is back at its place")
                                             : AcquirePage::tr("The camera is at its place");
}

}  // namespace

void AcquirePage::askAboutAlarm(const sentinels::Alarm& alarm, bool isPutRight) {
  PageCommand* goOn = sentinels::isAcceptable(alarm.kind) && !isPutRight ? skipAlarm_ : nullptr;
  QStringList advice;
  if (!isPutRight) advice << fullSentence(alarm.advice);
  advice << whatAnswersDo(alarm, goOn != nullptr);
  Failure failure{ErrorKind::device, fullSentence(alarm.what), advice.join('\n'),
                  QString::fromStdString(fmt::format("{}; {}; {}", alarm.what, alarm.safe, alarm.advice)),
                  AcquisitionTrace::headingOf(alarm.kind)};
  if (isPutRight) {
    failure.heading = putRightHeading(alarm.kind);
    failure.what = alarm.kind == sentinels::AlarmKind::moved
                       ? tr("It had moved while it measured, and looks again where it looked.")
                       : tr("It looks where it looked. Perhaps the light flickered.");
    if (const auto light = trace_.roomLight(); light && !light->isSteady)
      failure.what += '\n' + tr("The light of the room was another one, too: see that it is as it was.");
  }
  FailureReport report{failure, fullSentence(alarm.safe), retryAlarm_, keepAtAlarm_, goOn};
  if (viewBefore_.empty()) viewBefore_ = session_.live().floodlight().signal;
  const bool mayHaveMoved =
      alarm.kind == sentinels::AlarmKind::moved || alarm.kind == sentinels::AlarmKind::unsteady;
  if (mayHaveMoved && !viewBefore_.empty() && !isPutRight) report.repair = pushBack_;
  report.isPutRight = isPutRight;
  trace_.setAsked(alarm.kind);
  trace_.setPutRight(isPutRight);
  alarm_ = alarm;
  asking_ = std::make_unique<QObject>();
  report.reason = asking_.get();
  tellProgress();
  tellStatus();
  Q_EMIT failed(report);
  Q_EMIT asks();
}

/// In the words of the buttons.
QString AcquirePage::whatAnswersDo(const sentinels::Alarm& alarm, bool mayGoOn) const {
  QStringList answers;
  if (alarm.patterns > 0)
    answers << groupedText(tr("“%1” photographs %n pattern(s) again, from No. %2 on, and goes on from there.",
                              nullptr, alarm.patterns),
                           alarm.patterns)
                   .arg(retryAlarm_->text())
                   .arg(alarm.first + 1);
  else
    answers << tr("“%1” looks once more, and goes on.").arg(retryAlarm_->text());
  if (mayGoOn)
    answers << tr("“%1” keeps all as it is: what changed will be wrong, and the report says so.")
                   .arg(skipAlarm_->text());
  return answers.join('\n');
}

/// Whoever has closed the question finds it here again.
Banner AcquirePage::alarmBanner() const {
  return {Banner::Kind::amber,
          trace_.isPutRight() ? putRightHeading(alarm_->kind) : AcquisitionTrace::headingOf(alarm_->kind),
          trace_.isPutRight() ? tr("Measuring waits for your answer.") : fullSentence(alarm_->what), answer_};
}

void AcquirePage::askAgain(bool isPutRight) {
  if (alarm_ && isAsking()) askAboutAlarm(*alarm_, isPutRight);
}

PageCommand* AcquirePage::answering(Icon icon, sentinels::Answer answer) {
  return addCommand(icon, [this, answer] { this->answer(answer); });
}

void AcquirePage::answer(sentinels::Answer answer) {
  asking_.reset();
  trace_.setAsked(std::nullopt);
  if (answer == sentinels::Answer::retry) session_.putRight();
  question_->give(answer);
  tellProgress();
  tellStatus();
}

}  // namespace relucent::gui
