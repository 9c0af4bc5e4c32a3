// SPDX-License-Identifier: MIT
#include "wizard/acquire/block_sizes_view.h"

#include <QPainter>
#include <algorithm>
#include <cmath>

#include "theme/accessible_role.h"
#include "theme/controls.h"
#include "theme/theme.h"
#include "views/number_text.h"
#include "wizard/frame/page_view.h"

namespace relucent::gui {
namespace {

constexpr int planHeight = 112, progressHeight = 46, textHeight = 16;
constexpr double gap = 8.0, barHeight = 8.0, leastColumn = 4.0;

QString sizeText(const BlockLevel& level) {
  return AcquirePage::tr("%1 px").arg(countText(static_cast<std::uint64_t>(level.block)));
}

QString patternsText(const BlockLevel& level) {
  QString count = countText(static_cast<std::uint64_t>(std::llround(level.patterns.likely)));
  if (!level.isKnown) return AcquirePage::tr("about %1").arg(count);
  if (level.through == 0 || level.isComplete()) return count;
  return AcquirePage::tr("%1 of %2").arg(countText(static_cast<std::uint64_t>(level.through)), count);
}

void drawText(QPainter& painter, const QRectF& place, const QString& text) {
  painter.drawText(place, Qt::AlignHCenter | Qt::AlignVCenter,
                   painter.fontMetrics().elidedText(text, Qt::ElideRight, static_cast<int>(place.width())));
}

void drawExpected(QPainter& painter, const QRectF& place, double radius) {
  painter.setPen(QPen(colours().border, 1.0, Qt::DashLine));
  painter.setBrush(Qt::NoBrush);
  painter.drawRoundedRect(place.adjusted(0.5, 0.5, -0.5, -0.5), radius, radius);
}

void fill(QPainter& painter, const QRectF& place, const QColor& colour, double radius) {
  painter.setPen(Qt::NoPen);
  painter.setBrush(colour);
  painter.drawRoundedRect(place, radius, radius);
}

/// What is under way, for those who do not see it.
QString accessibleText(const std::vector<BlockLevel>& levels) {
  auto now =
      std::find_if(levels.rbegin(), levels.rend(), [](const BlockLevel& level) { return level.isKnown; });
  if (now == levels.rend()) return {};
  return AcquirePage::tr("Level %1 of %2, %3 of %4 patterns.")
      .arg(levels.rend() - now)
      .arg(levels.size())
      .arg(now->through)
      .arg(std::llround(now->patterns.likely));
}

}  // namespace

BlockSizesView::BlockSizesView(QWidget* parent) : QWidget(parent) {
  setObjectName("block-sizes");
  setAccessibleRole(this, QAccessible::Chart);
  setAccessibleName(AcquirePage::tr("Patterns for each block size"));
  connect(&Theme::instance(), &Theme::changed, this, [this] { update(); });
}

void BlockSizesView::show(std::vector<BlockLevel> levels, bool isMeasuring) {
  levels_ = std::move(levels);
  if (std::exchange(isMeasuring_, isMeasuring) != isMeasuring) updateGeometry();
  setAccessibleDescription(accessibleText(levels_));
  update();
}

QSize BlockSizesView::sizeHint() const {
  return {200, isMeasuring_ ? progressHeight : planHeight};
}

QRectF BlockSizesView::columnOf(std::size_t level) const {
  const double width = (this->width() + gap) / static_cast<double>(levels_.size());
  const auto place = static_cast<double>(isRightToLeft() ? levels_.size() - 1 - level : level);
  return {place * width, 0.0, width - gap, static_cast<double>(height())};
}

void BlockSizesView::paintEvent(QPaintEvent*) {
  if (levels_.empty()) return;
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setFont(typeOf(type::axis));
  if (isMeasuring_)
    paintProgress(painter);
  else
    paintPlan(painter);
}

void BlockSizesView::paintPlan(QPainter& painter) const {
  double most = 1.0;
  for (const BlockLevel& level : levels_) most = std::max(most, level.patterns.likely);
  for (std::size_t i = 0; i < levels_.size(); ++i) {
    const BlockLevel& level = levels_[i];
    QRectF column = columnOf(i);
    const double room = column.height() - 2.0 * textHeight - gap;
    const double high = std::max(leastColumn, room * level.patterns.likely / most);
    QRectF bar(column.left(), column.bottom() - textHeight - gap / 2.0 - high, column.width(), high);
    if (level.isKnown)
      fill(painter, bar, colours().good, 2.0);
    else
      drawExpected(painter, bar, 2.0);
    painter.setPen(colours().text);
    drawText(painter, QRectF(column.left(), bar.top() - textHeight, column.width(), textHeight),
             patternsText(level));
    painter.setPen(colours().secondary);
    drawText(painter, QRectF(column.left(), column.bottom() - textHeight, column.width(), textHeight),
             sizeText(level));
  }
}

void BlockSizesView::paintProgress(QPainter& painter) const {
  for (std::size_t i = 0; i < levels_.size(); ++i) {
    const BlockLevel& level = levels_[i];
    QRectF column = columnOf(i);
    const bool isNow = level.isKnown && !level.isComplete();
    QRectF bar(column.left(), textHeight + 2.0, column.width(), barHeight);
    if (!level.isKnown) {
      drawExpected(painter, bar, barHeight / 2.0);
    } else {
      fill(painter, bar, isNow ? colours().raised : colours().good, barHeight / 2.0);
      if (isNow && level.through > 0) {
        QRectF part = bar;
        part.setWidth(std::max(barHeight, bar.width() * level.through / level.patterns.likely));
        if (isRightToLeft()) part.moveRight(bar.right());
        fill(painter, part, colours().accent, barHeight / 2.0);
      }
    }
    painter.setPen(isNow ? colours().text : colours().secondary);
    drawText(painter, QRectF(column.left(), 0.0, column.width(), textHeight), sizeText(level));
    drawText(painter, QRectF(column.left(), bar.bottom() + 2.0, column.width(), textHeight),
             patternsText(level));
  }
}

QWidget* blockSizesCard(AcquirePage& model) {
  auto* card = new Card(AcquirePage::tr("Patterns for each block size"));
  auto* view = new BlockSizesView;
  card->body()->addWidget(view);
  card->setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Fixed);
  auto refresh = [&model, card, view] {
    std::vector<BlockLevel> levels = model.levels();
    card->setVisible(!levels.empty());
    const bool isPlan = std::ranges::any_of(levels, [](const BlockLevel& level) { return !level.isKnown; });
    const int count = model.patternsExpected();
    double divided = 0.0;
    for (const BlockLevel& level : levels) divided += level.patterns.likely;
    const QString checks =
        countText(static_cast<std::uint64_t>(std::max(0LL, count - std::llround(divided))));
    if (model.isMeasuring())
      card->setSubtitle(AcquirePage::tr("blocks are divided only where light needs it"));
    else if (isPlan)
      card->setSubtitle(
          groupedText(
              AcquirePage::tr("%n pattern(s) expected, %1 of them checks; known exactly as each level "
                              "begins",
                              nullptr, count),
              count)
              .arg(checks));
    else
      card->setSubtitle(
          groupedText(AcquirePage::tr("%n pattern(s), %1 of them checks", nullptr, count), count)
              .arg(checks));
    view->show(std::move(levels), model.isMeasuring());
  };
  refreshOn(model, card, refresh, &AcquirePage::progressChanged, &AcquirePage::settingsChanged,
            &AcquirePage::resultChanged);
  return card;
}

}  // namespace relucent::gui
