// SPDX-License-Identifier: MIT
#pragma once

#include <QImage>

#include "views/colour_map.h"
#include "views/plane_view.h"

namespace relucent::gui {

/// A view of a picture or map. Pixels are never smoothed beyond 100 %.
class ImageView : public PlaneView {
  Q_OBJECT

 public:
  explicit ImageView(QWidget* parent = nullptr) : PlaneView(parent) {}

  void setPicture(const QImage& picture);
  const QImage& picture() const { return picture_; }
  /// A transparent overlay of the same size.
  void setOverlay(const QImage& overlay);
  /// A colour bar at the right; `percent`: its values are shares.
  void setScale(const ColourScale& scale, const QString& unit, bool percent);
  /// Without a bar, too, its room stays free: beside a view that has one, pictures are of one size.
  void keepRoomForBar();
  /// The picture to the right of a divider, for comparison.
  void setCompared(const QImage& right, const QString& leftText, const QString& rightText);
  double divider() const { return divider_; }
  void setDivider(double share);
  /// Moves it to the middle of these columns of the picture, unless it is between them.
  void divideWithin(double left, double right);
  /// Position of the labels at the left or right of the divider.
  QRectF dividerTag(bool right) const;

 protected:
  QSize planeSize() const override { return picture_.size(); }
  QRectF frame() const override;
  void paintPlane(QPainter& painter) override;
  void paintOver(QPainter& painter) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;

  const QImage& overlay() const { return overlay_; }
  const std::optional<ColourScale>& scale() const { return scale_; }
  QRectF barArea() const;
  /// Whether pixels are larger than the screen's and are shown as squares.
  bool isEnlarged() const { return fit().width() * link().zoom() >= 1.0; }

 private:
  void paintDivider(QPainter& painter);

  QImage picture_, overlay_, compared_;
  QString leftText_, rightText_, unit_;
  std::optional<ColourScale> scale_;
  bool percent_ = false, dividing_ = false, keepsRoom_ = false;
  double divider_ = 0.5;
};

}  // namespace relucent::gui
