// SPDX-License-Identifier: MIT
#include "wizard/acquire/acquire_watch_view.h"

#include <algorithm>
#include <limits>

#include "theme/controls.h"
#include "theme/theme.h"
#include "views/line_chart.h"
#include "views/number_text.h"
#include "wizard/frame/page_view.h"

namespace relucent::gui {
namespace {

constexpr double percent = 100.0, minute = 60.0;
constexpr double leastMinutes = 0.5;
constexpr int traceHeight = 196;
constexpr std::size_t mostMarked = 12;  // readings, beyond which their marks would touch
constexpr std::size_t linesTakenAgain = 4;

/// Below which it is an alarm, too; room light is never below nothing.
double lowest(const sentinels::Reading& reading) {
  return std::max(0.0, reading.roomLightExpected - sentinels::reading_limit::roomLight);
}
double highest(const sentinels::Reading& reading) {
  return reading.roomLightExpected + sentinels::reading_limit::roomLight;
}

/// All values and limits, and room above them for the legend.
charts::Axis around(const std::vector<AcquisitionTrace::Point>& points, charts::Axis axis) {
  constexpr double legend = 0.5;
  if (points.empty()) return axis;
  double low = std::numeric_limits<double>::max(), high = 0.0;
  for (const AcquisitionTrace::Point& point : points) {
    low = std::min({low, point.reading.roomLight, lowest(point.reading)});
    high = std::max({high, point.reading.roomLight, highest(point.reading)});
  }
  axis.low = percent * low;
  axis.high = percent * (high + legend * (high - low));
  return axis;
}

std::vector<charts::Curve> curvesOf(const AcquisitionTrace& trace, double low) {
  charts::Curve light{{}, "information", charts::Marker::circle};
  charts::Curve above{AcquirePage::tr("alarm beyond").toStdString(), "amber"};
  charts::Curve below{{}, "amber"};
  for (const AcquisitionTrace::Point& point : trace.points()) {
    const sentinels::Reading& reading = point.reading;
    // Behind a lid it is dark whatever the room is like.
    if (reading.alarm == sentinels::AlarmKind::coveredLens) continue;
    double x = point.seconds / minute;
    light.line.push_back({x, percent * reading.roomLight});
    above.line.push_back({x, percent * highest(reading)});
    if (lowest(reading) > 0.0) below.line.push_back({x, percent * lowest(reading)});
  }
  if (light.line.size() <= mostMarked) light.points = light.line;
  // Limits stand from the beginning until now.
  for (charts::Curve* limit : {&above, &below}) {
    if (limit->line.empty()) continue;
    limit->line.insert(limit->line.begin(), {0.0, limit->line.front().y});
    limit->line.push_back({trace.seconds() / minute, limit->line.back().y});
  }
  charts::Curve again{AcquirePage::tr("taken again").toStdString(), "amber", charts::Marker::triangle};
  for (const AcquisitionTrace::Mark& mark : trace.marks())
    again.points.push_back({mark.seconds / minute, low});
  std::vector<charts::Curve> curves;
  if (!light.line.empty()) curves = {std::move(light), std::move(above), std::move(below)};
  if (!again.points.empty()) curves.push_back(std::move(again));
  return curves;
}

}  // namespace

QWidget* traceCard(AcquirePage& model) {
  auto* card = new Card(AcquirePage::tr("During the measurement"));
  card->setSubtitle(AcquirePage::tr("light that would spoil photographs"));
  card->setFixedHeight(traceHeight);
  const charts::Axis minutes = axisOf(0.0, leastMinutes, AcquirePage::tr("Minutes"));
  const charts::Axis light = axisOf(0.0, percent * sentinels::reading_limit::roomLight,
                                    AcquirePage::tr("Room light, % of full light"));
  auto* chart = new LineChart(minutes, light);
  chart->setObjectName("room-light-chart");
  chart->setAccessibleName(AcquirePage::tr("Room light during the measurement"));
  card->body()->addWidget(chart, 1);
  auto refresh = [&model, card, chart, minutes, light] {
    const AcquisitionTrace& trace = model.trace();
    // Beside a banner there is no room for it, nor need.
    card->setVisible(model.isMeasuring() ||
                     (model.isDone() && model.isTraceCurrent() && !trace.points().empty()));
    charts::Axis x = minutes, y = around(trace.points(), light);
    double now = trace.seconds() / minute;
    x.high = std::max(leastMinutes, now + model.secondsLeft().value_or(0.0) / minute);
    chart->setAxes(x, y);
    chart->setCurves(curvesOf(trace, y.low));
    chart->setMark(model.isMeasuring() ? now : std::numeric_limits<double>::quiet_NaN());
    chart->setAccessibleDescription(trace.states().front().figure);
  };
  refreshOn(model, card, refresh, &AcquirePage::progressChanged, &AcquirePage::resultChanged);
  return card;
}

QWidget* watchPart(AcquirePage& model) {
  auto* part = new QWidget;
  auto* column = new QVBoxLayout(part);
  column->setContentsMargins(0, 0, 0, 0);
  QLabel* title = labelOf(AcquirePage::tr("Taken again"), "section");
  auto* rows = new QGridLayout;
  rows->setColumnStretch(1, 1);
  std::array<std::pair<QLabel*, QLabel*>, linesTakenAgain> lines;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    lines[i] = {labelOf({}, "strong"), labelOf({}, "note")};
    lines[i].first->setWordWrap(false);
    rows->addWidget(lines[i].first, static_cast<int>(i), 0, Qt::AlignTop);
    rows->addWidget(lines[i].second, static_cast<int>(i), 1);
  }
  QFrame* line = lineOf();
  column->addWidget(title);
  column->addLayout(rows);
  column->addWidget(line);
  column->addWidget(labelOf(AcquirePage::tr("Watching"), "section"));
  std::array<Remark*, 4> watches;
  for (Remark*& watch : watches) column->addWidget(watch = new Remark);
  QLabel* often = labelOf({}, "note");
  column->addWidget(often);

  auto refresh = [&model, title, line, lines, watches, often] {
    const AcquisitionTrace& trace = model.trace();
    std::vector<TakenAgain> again = trace.takenAgain(lines.size());
    title->setVisible(!again.empty());
    line->setVisible(!again.empty());
    for (std::size_t i = 0; i < lines.size(); ++i) {
      bool isUsed = i < again.size();
      lines[i].first->setVisible(isUsed);
      lines[i].second->setVisible(isUsed);
      if (!isUsed) continue;
      lines[i].first->setText(again[i].patterns);
      lines[i].second->setText(again[i].reason);
    }
    std::array<WatchState, 4> states = trace.states();
    for (std::size_t i = 0; i < watches.size(); ++i)
      watches[i]->show(!states[i].isKnown   ? Remark::Kind::watch
                       : states[i].isSteady ? Remark::Kind::good
                                            : Remark::Kind::warning,
                       states[i].sentence, states[i].figure);
    often->setText(model.watching());
  };
  refreshOn(model, part, refresh, &AcquirePage::progressChanged, &AcquirePage::settingsChanged,
            &AcquirePage::resultChanged);
  return part;
}

}  // namespace relucent::gui
