// SPDX-License-Identifier: MIT
#include "theme/folding_rows.h"

#include <QStyle>
#include <QWidget>
#include <algorithm>

#include "theme/tokens.h"

namespace relucent::gui {
namespace {

/// How high it is at least, not how high it likes to be.
int leastHeight(QLayoutItem& item, int width) {
  const QWidget* widget = item.widget();
  const QLayout* inside = widget != nullptr ? widget->layout() : nullptr;
  if (inside == nullptr || !inside->hasHeightForWidth()) return item.minimumSize().height();
  return std::max(inside->totalMinimumHeightForWidth(width), widget->minimumHeight());
}

/// Heights of lines that together are `all` high: by their stretches, none less than its least.
std::vector<int> sharesOf(int all, const std::vector<int>& least, const std::vector<int>& stretches) {
  std::vector<int> heights(least.size(), 0);
  std::vector<bool> isFixed(least.size(), false);
  for (bool again = true; again;) {
    again = false;
    int left = all, stretch = 0;
    for (std::size_t i = 0; i < least.size(); ++i) isFixed[i] ? left -= least[i] : stretch += stretches[i];
    for (std::size_t i = 0; i < least.size(); ++i) {
      heights[i] = isFixed[i] ? least[i] : left * stretches[i] / std::max(stretch, 1);
      if (isFixed[i] || heights[i] >= least[i]) continue;
      isFixed[i] = again = true;
      break;
    }
  }
  return heights;
}

}  // namespace

FoldingRows::FoldingRows(QWidget* parent) : QLayout(parent) {
  setContentsMargins(0, 0, 0, 0);
  setSpacing(space::gap);
}

FoldingRows::~FoldingRows() = default;

void FoldingRows::addRow(std::initializer_list<QWidget*> cards, int stretch) {
  stretches_.push_back(stretch);
  for (QWidget* card : cards) addWidget(card);
}

void FoldingRows::addItem(QLayoutItem* item) {
  if (stretches_.empty()) stretches_.push_back(1);
  items_.push_back({std::unique_ptr<QLayoutItem>(item), stretches_.size() - 1});
}

int FoldingRows::count() const {
  return static_cast<int>(items_.size());
}

QLayoutItem* FoldingRows::itemAt(int index) const {
  return index >= 0 && index < count() ? items_[static_cast<std::size_t>(index)].item.get() : nullptr;
}

QLayoutItem* FoldingRows::takeAt(int index) {
  if (index < 0 || index >= count()) return nullptr;
  QLayoutItem* taken = items_[static_cast<std::size_t>(index)].item.release();
  items_.erase(items_.begin() + index);
  return taken;
}

int FoldingRows::partOf(int width, std::size_t items) const {
  const int count = static_cast<int>(items);
  return (width - (count - 1) * spacing()) / std::max(count, 1);
}

/// What the widest row needs.
int FoldingRows::rowsWidth() const {
  int widest = 0;
  for (std::size_t row = 0; row < stretches_.size(); ++row) {
    int one = 0, count = 0;
    for (const Item& item : items_)
      if (item.row == row && !item.item->isEmpty()) {
        one = std::max(one, item.item->minimumSize().width());
        ++count;
      }
    widest = std::max(widest, count * one + (count - 1) * spacing());
  }
  return widest;
}

std::vector<FoldingRows::Line> FoldingRows::linesAt(int width) const {
  const bool isFolded = isFoldedAt(width);
  std::vector<Line> lines;
  std::size_t row = stretches_.size();
  for (const Item& item : items_) {
    if (item.item->isEmpty()) continue;
    if (isFolded || item.row != row) lines.push_back({{}, 0, isFolded ? 1 : stretches_[item.row]});
    row = item.row;
    lines.back().items.push_back(item.item.get());
  }
  for (Line& line : lines) {
    if (isFolded) line.least = foldedHeight_;
    for (QLayoutItem* item : line.items)
      line.least = std::max(line.least, leastHeight(*item, partOf(width, line.items.size())));
  }
  return lines;
}

QSize FoldingRows::minimumSize() const {
  int width = 0;
  for (const Item& item : items_)
    if (!item.item->isEmpty()) width = std::max(width, item.item->minimumSize().width());
  return {width, 0};
}

QSize FoldingRows::sizeHint() const {
  const int width = rowsWidth();
  return {width, minimumHeightForWidth(width)};
}

int FoldingRows::minimumHeightForWidth(int width) const {
  int height = -spacing();
  for (const Line& line : linesAt(width)) height += line.least + spacing();
  return std::max(height, 0);
}

void FoldingRows::setGeometry(const QRect& place) {
  QLayout::setGeometry(place);
  const std::vector<Line> lines = linesAt(place.width());
  if (lines.empty()) return;
  std::vector<int> least, stretches;
  for (const Line& line : lines) {
    least.push_back(line.least);
    stretches.push_back(line.stretch);
  }
  const int room = place.height() - static_cast<int>(lines.size() - 1) * spacing();
  const std::vector<int> heights = sharesOf(room, least, stretches);
  const Qt::LayoutDirection direction =
      parentWidget() != nullptr ? parentWidget()->layoutDirection() : Qt::LeftToRight;
  int top = place.top();
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const int wide = partOf(place.width(), lines[i].items.size());
    int left = place.left();
    for (QLayoutItem* item : lines[i].items) {
      item->setGeometry(QStyle::visualRect(direction, place, QRect(left, top, wide, heights[i])));
      left += wide + spacing();
    }
    top += heights[i] + spacing();
  }
}

}  // namespace relucent::gui
