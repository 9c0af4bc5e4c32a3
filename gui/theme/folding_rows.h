// SPDX-License-Identifier: MIT
#pragma once

#include <QLayout>
#include <initializer_list>
#include <memory>
#include <vector>

namespace relucent::gui {

/// Rows of cards beside each other; where there is no room for that, all of them below each other, in the
/// same order: nothing has to be scrolled across.
class FoldingRows : public QLayout {
 public:
  /// Deletes nothing that `parent` owns. Margins are none.
  explicit FoldingRows(QWidget* parent);
  ~FoldingRows() override;

  /// `stretch`: the row's share of the height. In a row all are equally wide.
  void addRow(std::initializer_list<QWidget*> cards, int stretch = 1);
  /// How high each is at least where they are below each other.
  void setFoldedHeight(int pixels) { foldedHeight_ = pixels; }
  bool isFoldedAt(int width) const { return width < rowsWidth(); }

  void addItem(QLayoutItem* item) override;
  int count() const override;
  QLayoutItem* itemAt(int index) const override;
  QLayoutItem* takeAt(int index) override;
  QSize minimumSize() const override;
  QSize sizeHint() const override;
  bool hasHeightForWidth() const override { return true; }
  int heightForWidth(int width) const override { return minimumHeightForWidth(width); }
  int minimumHeightForWidth(int width) const override;
  void setGeometry(const QRect& place) override;

 private:
  struct Item {
    std::unique_ptr<QLayoutItem> item;
    std::size_t row = 0;
  };
  /// Cards beside each other, how high they are at least, and their share of what there is more.
  struct Line {
    std::vector<QLayoutItem*> items;
    int least = 0, stretch = 1;
  };
  std::vector<Line> linesAt(int width) const;
  int rowsWidth() const;
  int partOf(int width, std::size_t items) const;

  std::vector<Item> items_;
  std::vector<int> stretches_;  // a row's
  int foldedHeight_ = 0;
};

}  // namespace relucent::gui
