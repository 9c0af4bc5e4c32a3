// SPDX-License-Identifier: MIT
#include "theme/tick.h"

#include <QEvent>
#include <QStyle>
#include <QTextLayout>
#include <algorithm>

namespace relucent::gui {

Tick::Tick(const QString& text, QWidget* parent) : QCheckBox(text, parent), whole_(text) {
  setAccessibleName(text);
  QSizePolicy policy(QSizePolicy::Preferred, QSizePolicy::Preferred);
  policy.setHeightForWidth(true);
  setSizePolicy(policy);
}

QSize Tick::sizeOf(const QString& text) const {
  auto words = [this](const QString& shown) { return fontMetrics().size(Qt::TextShowMnemonic, shown); };
  int beside = QCheckBox::sizeHint().width() - words(this->text()).width();
  int box = style()->pixelMetric(QStyle::PM_IndicatorHeight, nullptr, this);
  return {words(text).width() + beside, std::max(box, words(text).height()) + 2};
}

QString Tick::inLines(int width) const {
  QTextLayout layout(whole_, font());
  int beside = sizeOf({}).width();
  QStringList lines;
  layout.beginLayout();
  for (QTextLine line = layout.createLine(); line.isValid(); line = layout.createLine()) {
    line.setLineWidth(std::max(1, width - beside));
    lines << whole_.mid(line.textStart(), line.textLength()).trimmed();
  }
  layout.endLayout();
  return lines.join('\n');
}

QSize Tick::sizeHint() const {
  return sizeOf(whole_);
}

QSize Tick::minimumSizeHint() const {
  // A word, or a sign where words are not apart.
  return {sizeOf(inLines(0)).width(), sizeHint().height()};
}

int Tick::heightForWidth(int width) const {
  return sizeOf(inLines(width)).height();
}

void Tick::fit() {
  if (QString lines = inLines(width()); lines != text()) setText(lines);
}

void Tick::resizeEvent(QResizeEvent* event) {
  QCheckBox::resizeEvent(event);
  fit();
}

void Tick::changeEvent(QEvent* event) {
  QCheckBox::changeEvent(event);
  if (event->type() == QEvent::FontChange) fit();
}

}  // namespace relucent::gui
