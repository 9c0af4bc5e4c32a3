// SPDX-License-Identifier: MIT
#include "wizard/output/nights_chart.h"

#include <QCoreApplication>
#include <QDateTime>
#include <QLocale>
#include <algorithm>
#include <cmath>

#include "text/message_text.h"
#include "text/written_times.h"
#include "views/line_chart.h"
#include "views/number_text.h"

namespace relucent::gui {
namespace {

/// Texts of this file.
struct Nights {
  Q_DECLARE_TR_FUNCTIONS(relucent::gui::Nights)
};

constexpr double drawnDays = 84.0, leastDays = 7.0;
constexpr double secondsADay = 86400.0;

QDateTime timeOf(const pipeline::NightRecord& night) {
  return timeWritten(night.when);
}

std::optional<double> figureOf(const std::optional<pipeline::PictureError>& error, NightFigure figure) {
  if (!error) return std::nullopt;
  const double value = figure == NightFigure::psnr ? error->psnr : error->deltaE;
  return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

QString repairText(pipeline::RepairEnd end) {
  switch (end) {
    case pipeline::RepairEnd::nothingToDo:
      return Nights::tr("The venue was as it was measured.");
    case pipeline::RepairEnd::repaired:
      return Nights::tr("Repaired.");
    case pipeline::RepairEnd::notBetter:
      return Nights::tr("Something has changed, and no better picture came of a repair.");
  }
  return {};
}

QString figureText(double value, NightFigure figure) {
  return figure == NightFigure::psnr ? Nights::tr("%1 dB").arg(decimalText(value, 1))
                                     : isolated(QString::fromUtf8("ΔE %1").arg(decimalText(value, 1)));
}

}  // namespace

NightsChart chartOf(const std::vector<pipeline::NightRecord>& nights, NightFigure figure) {
  NightsChart chart;
  charts::Curve measured{Nights::tr("Photographed").toStdString(), "accent", charts::Marker::circle},
      predicted{Nights::tr("Predicted").toStdString(), "information"},
      repairs{Nights::tr("Repaired").toStdString(), "green", charts::Marker::triangle},
      alarms{Nights::tr("Alarm").toStdString(), "red", charts::Marker::diamond};
  const QDateTime last = nights.empty() ? QDateTime() : timeOf(nights.back());
  double first = -leastDays, low = 0.0, high = 0.0;
  bool any = false;
  std::vector<double> without;  // when there were alarms without a photograph
  for (const pipeline::NightRecord& night : nights) {
    const double day = static_cast<double>(last.secsTo(timeOf(night))) / secondsADay;
    if (day < -drawnDays) continue;
    first = std::min(first, day);
    const std::optional<double> seen = figureOf(night.measured, figure),
                                foretold = figureOf(night.predicted, figure);
    for (const std::optional<double>& value : {seen, foretold}) {
      if (!value) continue;
      low = any ? std::min(low, *value) : *value;
      high = any ? std::max(high, *value) : *value;
      any = true;
    }
    if (seen) measured.line.push_back({day, *seen});
    if (foretold) predicted.line.push_back({day, *foretold});
    if (seen && night.repair == pipeline::RepairEnd::repaired) repairs.points.push_back({day, *seen});
    if (!night.alarm.empty() && seen) alarms.points.push_back({day, *seen});
    if (!night.alarm.empty() && !seen) without.push_back(day);
  }
  measured.points = measured.line;
  // A line of one point is nothing to see.
  if (predicted.line.size() == 1) {
    predicted.points = predicted.line;
    predicted.marker = charts::Marker::square;
  }
  if (figure == NightFigure::colourError) {
    low = 0.0;
    high = std::max(1.1 * high, 1.0);
  } else {
    low = std::floor(low) - 1.0;
    high = std::ceil(high) + 1.0;
  }
  for (const double day : without) alarms.points.push_back({day, low});
  chart.x = axisOf(first, 0.0, Nights::tr("Days before the last night"));
  chart.y = axisOf(low, high,
                   figure == NightFigure::psnr ? Nights::tr("Quality, dB") : Nights::tr("Colour error ΔE"));
  chart.summary = Nights::tr("%n night(s).", nullptr, static_cast<int>(nights.size()));
  if (!measured.line.empty()) {
    const auto [best, worst] = std::ranges::minmax_element(measured.line, {}, &charts::Point::y);
    chart.summary += ' ' + Nights::tr("Photographed: %1 to %2, last %3.")
                               .arg(figureText(best->y, figure), figureText(worst->y, figure),
                                    figureText(measured.line.back().y, figure));
  }
  chart.summary += ' ' + Nights::tr("Repairs: %1. Alarms: %2.")
                             .arg(countText(repairs.points.size()), countText(alarms.points.size()));
  // Marks are drawn over the curve.
  chart.curves = {predicted, measured};
  if (!repairs.points.empty()) chart.curves.push_back(repairs);
  if (!alarms.points.empty()) chart.curves.push_back(alarms);
  return chart;
}

QString nightTime(const pipeline::NightRecord& night) {
  return QLocale().toString(timeOf(night).toLocalTime(), QLocale::ShortFormat);
}

QString nightSentence(const pipeline::NightRecord& night) {
  if (!night.skipped.empty()) return Nights::tr("Left out: %1").arg(fullSentence(night.skipped));
  QStringList parts;
  if (!night.alarm.empty()) parts << Nights::tr("Alarm: %1").arg(fullSentence(night.alarm));
  if (night.repair) parts << repairText(*night.repair);
  for (const Message& what : night.what) parts << fullSentence(what);
  if (night.perfected > 0) parts << Nights::tr("%n picture(s) perfected.", nullptr, night.perfected);
  if (night.measured && night.predicted)
    parts << Nights::tr("Photographed: %1, predicted: %2.")
                 .arg(figureText(night.measured->deltaE, NightFigure::colourError),
                      figureText(night.predicted->deltaE, NightFigure::colourError));
  if (!night.untold.empty()) parts << Nights::tr("Nobody was told: %1").arg(fullSentence(night.untold));
  return parts.join(' ');
}

}  // namespace relucent::gui
