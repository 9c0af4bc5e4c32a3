// SPDX-License-Identifier: MIT
#include "views/cut_histogram.h"

#include <QKeyEvent>
#include <QPainter>
#include <algorithm>
#include <cmath>
#include <limits>

#include "theme/accessible_role.h"
#include "theme/theme.h"
#include "views/chart_drawing.h"

namespace relucent::gui {

CutHistogram::CutHistogram(charts::Axis x, const QString& countTitle, QWidget* parent)
    : QWidget(parent),
      chart_{{}, std::move(x), {1.0, 10.0, true, countTitle.toStdString()}},
      cut_(std::numeric_limits<double>::quiet_NaN()) {
  setFocusPolicy(Qt::StrongFocus);
  setAccessibleRole(this, QAccessible::Slider);
  connect(&Theme::instance(), &Theme::changed, this, qOverload<>(&QWidget::update));
}

QSize CutHistogram::minimumSizeHint() const {
  constexpr int leastHeight = 110;
  return {leastSizeOf(chart_).width(), leastHeight};
}

void CutHistogram::setBars(const std::vector<Bar>& bars) {
  chart_.columns.clear();
  followsCut_ = std::ranges::none_of(bars, [](const Bar& bar) { return bar.kept.has_value(); });
  double most = 1.0;
  for (const Bar& bar : bars) {
    most = std::max(most, bar.count);
    if (bar.count < 1.0) continue;
    if (!bar.kept) {
      chart_.columns.push_back({bar.from, bar.to, bar.count, {}});
      continue;
    }
    if (*bar.kept < bar.count) chart_.columns.push_back({bar.from, bar.to, bar.count, "dropped"});
    if (*bar.kept >= 1.0) chart_.columns.push_back({bar.from, bar.to, *bar.kept, "kept"});
  }
  chart_.y.high = std::pow(10.0, std::ceil(std::log10(most * 1.5)));
  update();
}

void CutHistogram::setAxis(const charts::Axis& x) {
  chart_.x = x;
  updateGeometry();
  update();
}

void CutHistogram::setCutText(const QString& text) {
  cutText_ = text;
  setAccessibleDescription(text);
  update();
}

void CutHistogram::setCut(double cut) {
  cut_ = cut;
  update();
}

void CutHistogram::move(double cut) {
  setCut(std::clamp(cut, chart_.x.low, chart_.x.high));
  Q_EMIT cutMoved(cut_);
}

void CutHistogram::dragTo(double x) {
  if (movable_ && plot_.width() > 0.0) move(chart_.x.value((x - plot_.left()) / plot_.width()));
}

void CutHistogram::mousePressEvent(QMouseEvent* event) {
  if (event->button() == Qt::LeftButton) dragTo(event->position().x());
}

void CutHistogram::mouseMoveEvent(QMouseEvent* event) {
  if (event->buttons() & Qt::LeftButton) dragTo(event->position().x());
}

void CutHistogram::keyPressEvent(QKeyEvent* event) {
  int direction = event->key() == Qt::Key_Right ? 1 : event->key() == Qt::Key_Left ? -1 : 0;
  if (direction == 0 || !movable_) return QWidget::keyPressEvent(event);
  double step = event->modifiers() & Qt::ShiftModifier ? 1.1 : 1.01;
  double from = std::isnan(cut_) || cut_ < chart_.x.low ? chart_.x.low : cut_;
  move(direction > 0 ? from * step : from / step);
}

void CutHistogram::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  if (followsCut_)
    for (charts::Column& column : chart_.columns)
      column.style = std::isnan(cut_) || !movable_ || column.to > cut_ ? "kept" : "dropped";
  plot_ = drawChart(painter, rect(), chart_);
  if (!std::isnan(cut_)) paintCut(painter);
  if (hasFocus()) {
    painter.setPen(QPen(colours().text, 2.0));
    painter.setBrush(Qt::NoBrush);
    painter.drawRoundedRect(QRectF(rect()).adjusted(1, 1, -1, -1), 6, 6);
  }
}

void CutHistogram::paintCut(QPainter& painter) const {
  double x = plot_.left() + std::clamp(chart_.x.place(cut_), 0.0, 1.0) * plot_.width();
  painter.setPen(QPen(colours().text, movable_ ? 2.0 : 1.5, movable_ ? Qt::SolidLine : Qt::DashLine));
  painter.drawLine(QPointF(x, plot_.top()), QPointF(x, plot_.bottom()));
  if (movable_) {
    QRectF grip(x - 7.0, plot_.center().y() - 13.0, 14.0, 26.0);
    painter.setPen(Qt::NoPen);
    painter.setBrush(colours().accent);
    painter.drawRoundedRect(grip, 4.0, 4.0);
    painter.setPen(QPen(colours().onAccent, 1.6));
    for (double y : {-5.0, 0.0, 5.0})
      painter.drawLine(QPointF(x - 3.5, grip.center().y() + y), QPointF(x + 3.5, grip.center().y() + y));
  }
  if (cutText_.isEmpty()) return;
  painter.setFont(typeOf(type::note, QFont::DemiBold));
  const QRectF box = cutTag();
  painter.setPen(colours().line);
  painter.setBrush(colours().input);
  painter.drawRoundedRect(box, 6.0, 6.0);
  painter.setPen(colours().text);
  painter.drawText(box, Qt::AlignCenter, cutText_);
}

QRectF CutHistogram::cutTag() const {
  constexpr double beside = 14.0, padding = 20.0, height = 26.0;
  const double x = plot_.left() + std::clamp(chart_.x.place(cut_), 0.0, 1.0) * plot_.width();
  const double wide =
      QFontMetricsF(typeOf(type::note, QFont::DemiBold)).horizontalAdvance(cutText_) + padding;
  const double left = x + beside + wide > plot_.right() ? x - beside - wide : x + beside;
  // Rather over the bars than cut.
  return {std::max(0.0, std::min(left, width() - wide)), plot_.top() + 2.0, wide, height};
}

}  // namespace relucent::gui
