// SPDX-License-Identifier: MIT
#pragma once

#include <QObject>
#include <QPointF>
#include <optional>

namespace relucent::gui {

/// State shared by linked views: centre, magnification, and pick in pixels of the plane.
class ViewLink : public QObject {
  Q_OBJECT

 public:
  using QObject::QObject;
  /// 1: the plane just fits.
  double zoom() const { return zoom_; }
  QPointF centre() const { return centre_; }  // relative to the plane
  std::optional<QPoint> pick() const { return pick_; }
  void look(double zoom, QPointF centre);
  void setPick(std::optional<QPoint> pick);
  /// The whole of another plane, in which nothing is picked.
  void reset();
  double mostZoom() const { return mostZoom_; }
  void setMostZoom(double most) { mostZoom_ = most; }

 Q_SIGNALS:
  void moved();
  void picked();

 private:
  double zoom_ = 1.0, mostZoom_ = 64.0;
  QPointF centre_{0.5, 0.5};
  std::optional<QPoint> pick_;
};

}  // namespace relucent::gui
