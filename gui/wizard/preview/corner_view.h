// SPDX-License-Identifier: MIT
#pragma once

#include "relucent/compensation/placement.h"
#include "views/image_view.h"

namespace relucent::gui {

/// A picture with a quadrilateral in it whose corners are dragged, or chosen by Tab and moved by the arrow
/// keys: one pixel, with Shift ten. D moves the divider, Shift+D back. Whoever owns the corners decides what
/// becomes of a move: see moved().
class CornerView : public ImageView {
  Q_OBJECT

 public:
  explicit CornerView(QWidget* parent = nullptr);

  /// Pixels of the picture; none: there is nothing to move.
  void setCorners(const std::optional<compensation::Corners>& corners);
  /// Drawn as what cannot be.
  void setWrong(bool wrong);
  /// The corner that the arrow keys move, clockwise from top left; -1: none.
  int active() const { return active_; }
  /// "Top left corner, 176, 92."
  QString cornerText(int corner) const;
  /// Where the active corner's words stand.
  QRectF cornerTag() const;
  /// What a corner's handle takes.
  QRectF handleArea(int corner) const;

 Q_SIGNALS:
  /// The user wants them there: within the picture, perhaps crossed.
  void moved(const relucent::compensation::Corners& corners);
  /// The user let go.
  void released();

 protected:
  std::vector<QRectF> keptFree() const override;
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  void focusInEvent(QFocusEvent* event) override;
  void focusOutEvent(QFocusEvent* event) override;
  bool focusNextPrevChild(bool next) override;

 private:
  QPointF handle(int corner) const;
  int handleAt(QPointF place) const;
  void activate(int corner);
  compensation::Corners with(int corner, QPointF place) const;
  std::optional<compensation::Corners> corners_, dragged_;
  bool wrong_ = false;
  int active_ = -1, held_ = -1;
};

}  // namespace relucent::gui
