// SPDX-License-Identifier: MIT
#pragma once

#include <QImage>
#include <QWidget>
#include <functional>
#include <optional>

#include "views/colour_map.h"

namespace relucent {

/// Where linked views look: one place and one magnification for all of them, in pixels of the picture.
class ViewLink : public QObject {
  Q_OBJECT

 public:
  using QObject::QObject;
  /// 1: the picture just fits.
  double zoom() const { return zoom_; }
  QPointF centre() const { return centre_; }  // in shares of the picture
  std::optional<QPoint> pick() const { return pick_; }
  void look(double zoom, QPointF centre);
  void setPick(std::optional<QPoint> pick);

 Q_SIGNALS:
  void moved();
  void picked();

 private:
  double zoom_ = 1.0;
  QPointF centre_{0.5, 0.5};
  std::optional<QPoint> pick_;
};

/// A picture or map to look at closely. The wheel zooms at the pointer, drag pans, a click picks;
/// double-click or 0 resets, 1 shows pixel for pixel, + and - zoom, arrows move the pick. Pixels are never
/// smoothed beyond 100 %. Several views of one raster share a ViewLink.
class ImageView : public QWidget {
  Q_OBJECT

 public:
  /// What stands beside the pick or under the pointer.
  using Readout = std::function<QString(QPoint pixel)>;

  explicit ImageView(QWidget* parent = nullptr);
  /// Contract: not nullptr; outlives the view.
  void setLink(ViewLink* link);
  ViewLink& link() const { return *link_; }

  void setPicture(const QImage& picture);
  const QImage& picture() const { return picture_; }
  /// Drawn over it, of its size, with transparency.
  void setOverlay(const QImage& overlay);
  /// With a bar at the right; `percent`: its values are shares.
  void setScale(const ColourScale& scale, const QString& unit, bool percent);
  void setReadout(Readout readout);
  /// Words while there is no picture.
  void setEmptyText(const QString& text);
  /// A word in the corner: "Out of date".
  void setBadge(const QString& text);
  void setScaleBar(bool shown);
  /// The picture that is drawn to the right of a divider; the other way to compare two.
  void setCompared(const QImage& right, const QString& leftText, const QString& rightText);
  double divider() const { return divider_; }
  void setDivider(double share);

  /// Where a place of the picture (in its pixels) is in the widget, and back.
  QPointF widgetFromPicture(QPointF place) const;
  QPointF pictureFromWidget(QPointF place) const;
  std::optional<QPoint> pixelAt(QPointF widgetPlace) const;

 protected:
  void paintEvent(QPaintEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;

 private:
  QRectF frame() const;  // what the picture may fill
  double fittingScale() const;
  QRectF target() const;  // where the whole picture lies
  void zoomAt(QPointF widgetPlace, double factor);
  void movePick(int dx, int dy);
  void paintPicture(QPainter& painter);
  void paintPick(QPainter& painter);
  void paintScaleBar(QPainter& painter);
  void paintDivider(QPainter& painter);

  ViewLink own_;
  ViewLink* link_ = &own_;
  QImage picture_, overlay_, compared_;
  QString leftText_, rightText_, emptyText_, badge_, unit_;
  std::optional<ColourScale> scale_;
  bool percent_ = false, scaleBar_ = false;
  Readout readout_;
  double divider_ = 0.5;
  QPointF pressed_, lastDrag_;
  bool dragging_ = false, dividing_ = false;
};

/// A small dark box with words, as it stands over pictures.
void drawTag(QPainter& painter, QPointF topLeft, const QString& text, const QColor& colour,
             bool rightAligned = false);

}  // namespace relucent
