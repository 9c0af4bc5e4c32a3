// SPDX-License-Identifier: MIT
#include "output/rehearsal_clock.h"

#include <QStringList>
#include <algorithm>
#include <cmath>
#include <utility>

#include "relucent/base/error.h"
#include "relucent/base/file.h"

namespace relucent::gui {
namespace {

QString firstLineOf(const QString& file) {
  return QString::fromStdString(readFile(file.toStdString())).section('\n', 0, 0).trimmed();
}

}  // namespace

std::optional<RehearsalPlan> rehearsalPlanFrom(const QString& line) {
  const QStringList words = line.split(' ', Qt::SkipEmptyParts);
  if (words.size() != 3) return std::nullopt;
  bool isNumber = false;
  const RehearsalPlan plan{QDateTime::fromString(words[0], Qt::ISODate),
                           QDateTime::fromString(words[1], Qt::ISODate), words[2].toDouble(&isNumber)};
  const bool isPlan = plan.from.isValid() && plan.until >= plan.from && isNumber && plan.speed >= 1.0 &&
                      std::isfinite(plan.speed);
  return isPlan ? std::optional(plan) : std::nullopt;
}

RehearsalClock::RehearsalClock(QString file, Now now) : file_(std::move(file)), now_(std::move(now)) {
  const std::optional<RehearsalPlan> plan = rehearsalPlanFrom(firstLineOf(file_));
  if (!plan)
    throw Error(
        ErrorKind::format,
        RELUCENT_ENGLISH_MESSAGE("show.no-rehearsal-plan", "the file says no time for a rehearsal"),
        RELUCENT_ENGLISH_MESSAGE("show.write-rehearsal-plan",
                                 "write one line of when it begins, when it stands still, and how fast "
                                 "it is: 2026-05-04T08:50 2026-05-04T18:10 1000"),
        file_.toStdString());
  plan_ = *plan;
  begun_ = plan_.from;
  since_ = now_();
}

QDateTime RehearsalClock::now() const {
  const double passed = std::chrono::duration<double, std::milli>(now_() - since_).count() * plan_.speed;
  // As milliseconds, since what a long pause makes of a great speed is no date.
  const double left = static_cast<double>(std::max<qint64>(begun_.msecsTo(plan_.until), 0));
  return begun_.addMSecs(static_cast<qint64>(std::min(passed, left)));
}

void RehearsalClock::follow() {
  try {
    const std::optional<RehearsalPlan> plan = rehearsalPlanFrom(firstLineOf(file_));
    if (!plan || *plan == plan_) return;
    begun_ = now();
    since_ = now_();
    plan_ = *plan;
  } catch (const Error&) {  // it goes on as it did
  }
}

}  // namespace relucent::gui
