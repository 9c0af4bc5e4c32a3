// SPDX-License-Identifier: MIT
#include "output/show_nights.h"

#include <ranges>

#include "output/output_playlist.h"
#include "relucent/base/error.h"
#include "text/written_times.h"

namespace relucent::gui {
namespace {

QString englishOf(const Message& sentence) {
  return QString::fromStdString(english(sentence));
}

QDateTime timeOf(const pipeline::NightRecord& night) {
  return timeWritten(night.when);
}

}  // namespace

ShowNights::ShowNights(const ShowSettings& settings, const QDateTime& now)
    : settings_(settings), schedule_(*settings.night, settings.hours), handled_(schedule_.dueBefore(now)) {
  recall();
  if (last_ && timeOf(*last_) < handled_) handled_ = schedule_.dueBefore(timeOf(*last_).toLocalTime());
}

void ShowNights::recall() {
  try {
    const std::vector<pipeline::NightRecord> nights = pipeline::nightsOf(settings_.calibration);
    if (nights.empty()) return;
    last_ = nights.back();
    // A night that was left out says nothing of the one before it.
    for (const pipeline::NightRecord& night : nights | std::views::reverse) {
      alarm_ = night.alarm;
      if (night.skipped.empty()) break;
    }
  } catch (const Error&) {  // the next night sets it aside
  }
}

ShowNights::Step ShowNights::stepAt(const QDateTime& now) {
  if (begun_) return schedule_.mustEnd(*begun_, now) ? Step::end : Step::none;
  const QDateTime due = schedule_.dueBefore(now);
  if (due <= handled_) return Step::none;
  return schedule_.mayBegin(due, now) ? Step::begin : Step::missed;
}

void ShowNights::begin(const QDateTime& now) {
  begun_ = now;
  handled_ = schedule_.dueBefore(now);
}

void ShowNights::ended(const QDateTime& now, const Message& failure) {
  begun_.reset();
  handled_ = schedule_.dueBefore(now);
  if (failure.empty())
    recall();
  else
    alarm_ = failure;
}

pipeline::NightRecord ShowNights::recordAt(const QDateTime& now) const {
  pipeline::NightRecord record;
  record.when = written(now);
  return record;
}

void ShowNights::leaveOut(const QDateTime& now, const Message& why) {
  begun_.reset();
  handled_ = schedule_.dueBefore(now);
  pipeline::NightRecord record = recordAt(now);
  record.skipped = why;
  addNight(settings_.calibration, record);
  recall();
}

void ShowNights::raise(const QDateTime& now, const Message& alarm) {
  begun_.reset();
  handled_ = schedule_.dueBefore(now);
  alarm_ = alarm;
  pipeline::NightRecord record = recordAt(now);
  record.alarm = alarm;
  closeNight(settings_.calibration, record, settings_.alarmCommand);
  recall();
}

pipeline::NightSettings ShowNights::work() const {
  pipeline::NightSettings work;
  for (const PlaylistItem& item : settings_.content.items)
    if (OutputPlaylist::isStill(item)) work.images.emplace_back(item.path.toStdString());
  work.canvas = {{settings_.canvas.size.width(), settings_.canvas.size.height()}, settings_.canvas.fit};
  work.alarmCommand = settings_.alarmCommand;
  return work;
}

QJsonObject ShowNights::health(const QDateTime& now) const {
  QJsonObject night{{"next", schedule_.dueAfter(now).toString(Qt::ISODate)}};
  if (!last_) return night;
  night["when"] = timeOf(*last_).toLocalTime().toString(Qt::ISODate);
  night["outcome"] = englishOf(sentenceOf(*last_));
  night["pictures_perfected"] = last_->perfected;
  if (last_->measured) night["delta_e"] = last_->measured->deltaE;
  if (last_->predicted) night["delta_e_predicted"] = last_->predicted->deltaE;
  if (!last_->untold.empty()) night["untold"] = englishOf(last_->untold);
  return night;
}

Message sentenceOf(const pipeline::NightRecord& night) {
  if (!night.skipped.empty())
    return RELUCENT_ENGLISH_MESSAGE("show.night-left-out", "left out: {}").with(night.skipped);
  if (!night.alarm.empty()) return night.alarm;
  if (night.repair) return Message::plain(std::string(descriptionOf(*night.repair)));
  return {};
}

}  // namespace relucent::gui
