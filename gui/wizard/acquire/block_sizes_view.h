// SPDX-License-Identifier: MIT
#pragma once

#include <QWidget>
#include <vector>

#include "wizard/acquire/acquire_page.h"

namespace relucent::gui {

/// The patterns of every block size: as a plan before measuring, columns as high as there are many, and as
/// progress while it goes on. What is only expected is dashed.
class BlockSizesView : public QWidget {
  Q_OBJECT

 public:
  explicit BlockSizesView(QWidget* parent = nullptr);
  void show(std::vector<BlockLevel> levels, bool isMeasuring);

  QSize sizeHint() const override;
  QSize minimumSizeHint() const override { return sizeHint(); }

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  void paintPlan(QPainter& painter) const;
  void paintProgress(QPainter& painter) const;
  QRectF columnOf(std::size_t level) const;

  std::vector<BlockLevel> levels_;
  bool isMeasuring_ = false;
};

/// The card of it, hidden where nothing is known.
QWidget* blockSizesCard(AcquirePage& model);

}  // namespace relucent::gui
