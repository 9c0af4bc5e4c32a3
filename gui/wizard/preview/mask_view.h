// SPDX-License-Identifier: MIT
#pragma once

#include "relucent/compensation/mask.h"
#include "wizard/preview/corner_view.h"

namespace relucent::gui {

/// A picture with the masks of its view in it, hatched, beside the content's corners. The chosen mask's
/// points are dragged, or chosen by Tab and moved by the arrow keys, with Shift ten pixels; Delete takes the
/// chosen point away, or the mask if no point is chosen. While one is drawn, a click sets a point, and so
/// does Space where the arrow keys have led; Return, or a click on the first point, closes it; Backspace
/// takes the last point back, Escape leaves it. Whoever owns the masks decides what becomes of all that.
class MaskView : public CornerView {
  Q_OBJECT

 public:
  using Points = std::vector<std::array<double, 2>>;

  explicit MaskView(QWidget* parent = nullptr) : CornerView(parent) {}

  /// Of this view; `chosen`: which of them has handles, -1: none.
  void setMasks(const std::vector<compensation::Mask>& masks, int chosen);
  /// Begins with no points, or ends.
  void setDrawing(bool drawing, compensation::Outline outline);
  bool isDrawing() const { return drawing_; }
  const Points& drawn() const { return drawn_; }
  /// The point of the chosen mask that the keys move; -1: none.
  int activePoint() const { return point_; }
  /// What the keys would change now: "Point 2 of 4, 120, 80."
  QString pointText() const;

 Q_SIGNALS:
  void closed(const relucent::gui::MaskView::Points& points);
  void cancelled();
  void pointsMoved(int mask, const relucent::gui::MaskView::Points& points);
  void removed(int mask);
  void picked(int mask);

 protected:
  std::vector<QRectF> keptFree() const override;
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  bool event(QEvent* event) override;
  void focusInEvent(QFocusEvent* event) override;
  bool focusNextPrevChild(bool next) override;

 private:
  const compensation::Mask* chosen() const;
  QPointF widgetFromMask(const std::array<double, 2>& point) const;
  std::array<double, 2> maskFromWidget(QPointF place) const;
  QPolygonF outlineOf(const compensation::Mask& mask) const;
  int pointAt(const Points& points, QPointF place) const;
  int maskAt(QPointF place) const;
  void activate(int point);
  void tell();
  void addPoint(const std::array<double, 2>& point);
  void close();
  void drawByKey(QKeyEvent* event);
  void removePoint();
  std::array<double, 2> step(std::array<double, 2> from, int key, bool far) const;

  std::vector<compensation::Mask> masks_;
  int chosen_ = -1, point_ = -1, held_ = -1;
  bool drawing_ = false;
  compensation::Outline outline_ = compensation::Outline::lines;
  Points drawn_;
  std::array<double, 2> cursor_{0.5, 0.5};  // where the next point is set by key
};

}  // namespace relucent::gui
