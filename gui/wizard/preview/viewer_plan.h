// SPDX-License-Identifier: MIT
#pragma once

#include <QWidget>
#include <optional>
#include <vector>

#include "relucent/compensation/viewer.h"

namespace relucent::gui {

/// A plan, seen from above, the surface at its upper edge: cameras and a viewer, who are dragged, or chosen
/// by Tab and moved by the arrow keys: a tenth of a metre, with Shift a whole one. Whoever owns the places
/// decides what becomes of a move.
class ViewerPlan : public QWidget {
  Q_OBJECT

 public:
  explicit ViewerPlan(QWidget* parent = nullptr);

  /// Metres: to the right of the surface's middle, and away from it. `shares`: how much each camera's view
  /// counts, drawn as a line from the viewer; empty: none.
  void show(const std::vector<compensation::Position>& cameras,
            const std::optional<compensation::Position>& viewer, const std::vector<double>& shares);
  /// Cameras in their order, then the viewer; -1: none.
  int active() const { return active_; }
  /// "Camera 2: 1.5 m to the right, 2.1 m from the surface"
  QString placeText(int point) const;
  /// Where a point is drawn.
  QPointF placeOf(int point) const;

 Q_SIGNALS:
  void cameraMoved(int camera, const relucent::compensation::Position& to);
  void viewerMoved(const relucent::compensation::Position& to);

 protected:
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  void focusInEvent(QFocusEvent* event) override;
  void focusOutEvent(QFocusEvent* event) override;
  bool focusNextPrevChild(bool next) override;

 private:
  int points() const;
  compensation::Position positionOf(int point) const;
  QPointF widgetFromMetres(const compensation::Position& position) const;
  compensation::Position metresFromWidget(QPointF place) const;
  void activate(int point);
  void move(int point, const compensation::Position& to);
  void chooseRoom();

  std::vector<compensation::Position> cameras_;
  std::optional<compensation::Position> viewer_;
  std::vector<double> shares_;
  double room_ = 4.0;  // metres from the middle to an edge, and from the surface
  int active_ = -1, held_ = -1;
};

}  // namespace relucent::gui
