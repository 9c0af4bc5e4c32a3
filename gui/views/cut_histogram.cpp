// SPDX-License-Identifier: MIT
#include "views/cut_histogram.h"

#include <QKeyEvent>
#include <QPainter>
#include <algorithm>
#include <cmath>
#include <limits>

#include "theme/theme.h"
#include "views/line_chart.h"

namespace relucent::gui {

CutHistogram::CutHistogram(Axis x, QString countTitle, QWidget* parent)
    : QWidget(parent), x_(std::move(x)), cut_(std::numeric_limits<double>::quiet_NaN()) {
  counts_ = {1.0, 10.0, true, std::move(countTitle)};
  setFocusPolicy(Qt::StrongFocus);
  connect(&Theme::instance(), &Theme::changed, this, qOverload<>(&QWidget::update));
}

QSize CutHistogram::minimumSizeHint() const {
  constexpr int leastHeight = 110;
  return {leastSizeOf(x_, counts_).width(), leastHeight};
}

void CutHistogram::setBars(std::vector<Bar> bars) {
  bars_ = std::move(bars);
  double most = 1.0;
  for (const Bar& bar : bars_) most = std::max(most, bar.count);
  counts_.high = std::pow(10.0, std::ceil(std::log10(most * 1.5)));
  update();
}

void CutHistogram::setAxis(const Axis& x) {
  x_ = x;
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
  setCut(std::clamp(cut, x_.low, x_.high));
  Q_EMIT cutMoved(cut_);
}

void CutHistogram::dragTo(double x) {
  if (movable_ && plot_.width() > 0.0) move(x_.value((x - plot_.left()) / plot_.width()));
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
  double from = std::isnan(cut_) || cut_ < x_.low ? x_.low : cut_;
  move(direction > 0 ? from * step : from / step);
}

void CutHistogram::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  plot_ = drawAxes(painter, rect(), x_, counts_);
  QColor kept = colours().accent, out = colours().border;
  kept.setAlphaF(0.8f);
  out.setAlphaF(0.45f);
  for (const Bar& bar : bars_) {
    if (!(bar.count >= 1.0)) continue;
    double left = plot_.left() + x_.place(bar.from) * plot_.width();
    double right = plot_.left() + x_.place(bar.to) * plot_.width();
    double height = std::max(0.02, counts_.place(bar.count)) * plot_.height();
    bool isKept = std::isnan(cut_) || !movable_ || bar.to > cut_;
    painter.fillRect(QRectF(left + 1.0, plot_.bottom() - height, std::max(1.0, right - left - 2.0), height),
                     isKept ? kept : out);
  }
  if (!std::isnan(cut_)) paintCut(painter);
  if (hasFocus()) {
    painter.setPen(QPen(colours().text, 2.0));
    painter.setBrush(Qt::NoBrush);
    painter.drawRoundedRect(QRectF(rect()).adjusted(1, 1, -1, -1), 6, 6);
  }
}

void CutHistogram::paintCut(QPainter& painter) const {
  double x = plot_.left() + std::clamp(x_.place(cut_), 0.0, 1.0) * plot_.width();
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
  double width = painter.fontMetrics().horizontalAdvance(cutText_) + 20.0;
  double left = x + 14.0 + width > plot_.right() ? x - 14.0 - width : x + 14.0;
  QRectF box(left, plot_.top() + 2.0, width, 26.0);
  painter.setPen(colours().line);
  painter.setBrush(colours().input);
  painter.drawRoundedRect(box, 6.0, 6.0);
  painter.setPen(colours().text);
  painter.drawText(box, Qt::AlignCenter, cutText_);
}

}  // namespace relucent::gui
