// SPDX-License-Identifier: MIT
#include "output/show_projectors.h"

#include <QJsonObject>

#include "relucent/base/message.h"

namespace relucent::gui {
namespace {

QString named(std::string_view name) {
  return QString::fromUtf8(name.data(), static_cast<qsizetype>(name.size()));
}

QJsonValue sizeOf(const Size& size) {
  return QString("%1x%2").arg(size.width).arg(size.height);
}

QJsonValue signalOf(const pjlink::Report& report) {
  if (!report.signal || report.signal->kind == pjlink::Signal::Kind::unknown) return {};
  if (report.signal->kind == pjlink::Signal::Kind::none) return "none";
  return sizeOf(report.signal->size);
}

QJsonArray remarksOf(const ProjectorState& state) {
  QJsonArray remarks;
  const std::string label = state.label.toStdString();
  for (const std::vector<Message>& sentences :
       {troublesOf(*state.report, label), harmfulSettings(*state.report, label, std::nullopt)})
    for (const Message& sentence : sentences) remarks.append(QString::fromStdString(english(sentence)));
  return remarks;
}

QJsonObject toJson(const ProjectorState& state) {
  QJsonObject json{{"projector", state.label}, {"address", state.address}};
  if (!state.wasAsked) return json;
  json["answers"] = state.report.has_value();
  if (!state.report) {
    json["problem"] = QString::fromStdString(english(state.problem));
    return json;
  }
  const pjlink::Report& report = *state.report;
  QJsonArray lamps;
  for (const pjlink::Lamp& lamp : report.lamps) lamps.append(lamp.hours);
  json["name"] = QString::fromStdString(report.name);
  json["model"] = QString::fromStdString(report.maker + " " + report.model).trimmed();
  if (report.power) json["power"] = named(nameOf(*report.power));
  if (report.shutter) json["shutter"] = report.shutter->picture ? "closed" : "open";
  json["lamp_hours"] = lamps;
  if (report.filterHours) json["filter_hours"] = *report.filterHours;
  json["input"] = QString::fromStdString(report.inputName.empty() ? report.input : report.inputName);
  json["signal"] = signalOf(report);
  if (report.ownPixels) json["own_size"] = sizeOf(*report.ownPixels);
  json["remarks"] = remarksOf(state);
  return json;
}

}  // namespace

pjlink::Wanted ProjectorWishes::at(const QDateTime& now, bool plays, bool black) {
  const bool isDark = !plays || black;
  if (!isDark)
    darkSince_.reset();
  else if (!darkSince_ || *darkSince_ > now)  // a clock that was set back
    darkSince_ = now;
  if (!offAfter_) return {plays, isDark};
  const bool isOver = isDark && darkSince_->secsTo(now) >= std::chrono::seconds(*offAfter_).count();
  return {!isOver, isDark};
}

std::unique_ptr<ProjectorWatch> watchOf(const ShowSettings& settings, const pjlink::Wanted& wanted,
                                        const MachineClock& clock) {
  if (settings.projectors.empty()) return nullptr;
  std::vector<WatchedProjector> projectors;
  for (const ShowProjector& projector : settings.projectors) {
    pjlink::KeeperSettings keeping;
    keeping.label = projector.label;
    keeping.sent = projector.sent;
    keeping.switchesPower = settings.switchesPower;
    keeping.closesShutter = settings.closesShutter;
    for (std::chrono::milliseconds* time :
         {&keeping.interval, &keeping.soon, &keeping.longestPause, &keeping.obeys})
      *time = clock.pause(*time);
    projectors.push_back({projector.address, std::move(keeping)});
  }
  return std::make_unique<ProjectorWatch>(std::move(projectors), wanted);
}

QJsonArray toJson(const std::vector<ProjectorState>& projectors) {
  QJsonArray list;
  for (const ProjectorState& state : projectors) list.append(toJson(state));
  return list;
}

}  // namespace relucent::gui
