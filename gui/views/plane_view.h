// SPDX-License-Identifier: MIT
#pragma once

#include <QPointer>
#include <QWidget>
#include <functional>
#include <optional>
#include <vector>

#include "views/view_link.h"

namespace relucent::gui {

class VtkView;

/// A zoomable plane of pixels, the base of the views of pictures, maps and T. The wheel zooms at the pointer,
/// drag pans, a click picks; double-click or 0 resets, 1 shows pixel for pixel, + and - zoom, arrows move the
/// pick, with Shift ten pixels; F11 switches to full screen and Esc back. Several views of one raster share a
/// ViewLink. A subclass paints the plane, or has a VTK scene drawn below everything else.
class PlaneView : public QWidget {
  Q_OBJECT

 public:
  /// The text beside the pick, and in the corner for the pixel under the pointer.
  using Readout = std::function<QString(QPoint pixel)>;

  explicit PlaneView(QWidget* parent = nullptr);
  ~PlaneView() override;
  /// Contract: not nullptr; outlives the view.
  void setLink(ViewLink* link);
  ViewLink& link() const { return *link_; }

  void setReadout(Readout readout);
  /// The text shown while there is no plane.
  void setEmptyText(const QString& text);
  const QString& emptyText() const { return emptyText_; }
  /// A label in the corner: "Out of date".
  void setBadge(const QString& text);
  /// A text in the lower left corner: the state of the displayed picture.
  void setCaption(const QString& text);
  void setScaleBar(bool shown);

  /// Full screen, or back in its page. Contract: it is in a layout.
  void setWholeScreen(bool whole);
  bool isWholeScreen() const { return whole_ != nullptr; }

  /// Converts positions on the plane (in its pixels) to the widget and back.
  QPointF widgetFromPicture(QPointF place) const;
  QPointF pictureFromWidget(QPointF place) const;
  std::optional<QPoint> pixelAt(QPointF widgetPlace) const;

  /// The visible picture with everything drawn over it, in device pixels.
  QImage asSeen();

 protected:
  /// Pixels of the plane; empty: there is none.
  virtual QSize planeSize() const = 0;
  /// Pixels are square; else the plane is stretched to its frame.
  virtual bool keepsAspect() const { return true; }
  /// The area available to the plane.
  virtual QRectF frame() const { return rect(); }
  /// Areas to keep free of text.
  virtual std::vector<QRectF> keptFree() const { return {}; }
  /// False: something other than the plane is shown, which has no pick.
  virtual bool isFlat() const { return true; }
  virtual void paintPlane(QPainter&) {}
  /// Besides pick, scale bar and badge.
  virtual void paintOver(QPainter&) {}
  /// Updates the positions of the VTK scene.
  virtual void arrange() {}

  /// Draws a scene instead of paintPlane(). Contract: called once, in a constructor.
  void useVtk();
  VtkView* vtk() const { return vtk_; }
  /// Back to paintPlane().
  void dropVtk();
  /// Schedules a repaint.
  void refresh();

  QSizeF fit() const;     // widget pixels per pixel of the plane where it just fits, horizontal and vertical
  QRectF target() const;  // rectangle of the whole plane
  void zoomAt(QPointF widgetPlace, double factor);
  std::optional<QPoint> hovered() const { return hovered_; }

  bool event(QEvent* event) override;
  void paintEvent(QPaintEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;

 private:
  static constexpr double cornerRadius = 4.0;  // the cards'
  class Glass;
  void look(double zoom, QPointF centre) { link_->look(zoom, centre); }
  void movePick(int dx, int dy);
  /// Only what is drawn over the plane has changed.
  void refreshWords();
  void paintWords(QPainter& painter);
  void paintMarks(QPainter& painter);
  void paintCrossOfPick(QPainter& painter);
  void paintPickReadout(QPainter& painter);
  void paintTag(QPainter& painter, QPointF topLeft, const QString& text, const QColor& colour,
                bool rightAligned = false);
  std::optional<QPointF> placeOfPick() const;
  QRectF roomForTag(const QString& text) const;
  void paintScaleBar(QPainter& painter);

  ViewLink own_;
  ViewLink* link_ = &own_;
  VtkView* vtk_ = nullptr;
  Glass* glass_ = nullptr;
  QPointer<QWidget> whole_;
  QString emptyText_, badge_, caption_;
  bool scaleBar_ = false, dragging_ = false;
  bool saving_ = false;  // without decoration, that is corners and focus
  Readout readout_;
  QPointF pressed_, lastDrag_;
  std::optional<QPoint> hovered_;
};

}  // namespace relucent::gui
