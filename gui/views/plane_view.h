// SPDX-License-Identifier: MIT
#pragma once

#include <QPointer>
#include <QWidget>
#include <functional>
#include <optional>
#include <vector>

#include "views/view_link.h"

namespace relucent {

class VtkView;

/// A plane of pixels to look at closely: what pictures, maps and T have in common. The wheel zooms at the
/// pointer, drag pans, a click picks; double-click or 0 resets, 1 shows pixel for pixel, + and - zoom, arrows
/// move the pick, with Shift ten pixels; F11 shows it on the whole screen and Esc in its page again. Several
/// views of one raster share a ViewLink. A subclass paints the plane, or has a VTK scene drawn below
/// everything else.
class PlaneView : public QWidget {
  Q_OBJECT

 public:
  /// What stands beside the pick, and in the corner for the pixel under the pointer.
  using Readout = std::function<QString(QPoint pixel)>;

  explicit PlaneView(QWidget* parent = nullptr);
  ~PlaneView() override;
  /// Contract: not nullptr; outlives the view.
  void setLink(ViewLink* link);
  ViewLink& link() const { return *link_; }

  void setReadout(Readout readout);
  /// Words while there is no plane.
  void setEmptyText(const QString& text);
  /// A word in the corner: "Out of date".
  void setBadge(const QString& text);
  /// Words in the lower left corner: how it goes with what is seen.
  void setCaption(const QString& text);
  void setScaleBar(bool shown);

  /// On the whole screen, or back in its page. Contract: it lies in a layout.
  void setWholeScreen(bool whole);
  bool isWholeScreen() const { return whole_ != nullptr; }

  /// Where a place of the plane (in its pixels) is in the widget, and back.
  QPointF widgetFromPicture(QPointF place) const;
  QPointF pictureFromWidget(QPointF place) const;
  std::optional<QPoint> pixelAt(QPointF widgetPlace) const;

  /// What is seen, with everything that stands over it, in device pixels.
  QImage asSeen();

 protected:
  /// Pixels of the plane; empty: there is none.
  virtual QSize planeSize() const = 0;
  /// Pixels are square; else the plane is stretched to its frame.
  virtual bool keepsAspect() const { return true; }
  /// What the plane may fill.
  virtual QRectF frame() const { return rect(); }
  /// Where words must not stand.
  virtual std::vector<QRectF> keptFree() const { return {}; }
  /// False: something else is seen than the plane, and nothing is picked in it.
  virtual bool isFlat() const { return true; }
  virtual void paintPlane(QPainter&) {}
  /// Beside pick, scale bar and badge.
  virtual void paintOver(QPainter&) {}
  /// Moves what VTK draws to where it belongs.
  virtual void arrange() {}

  /// Has a scene drawn in place of paintPlane(). Contract: once, in a constructor.
  void useVtk();
  VtkView* vtk() const { return vtk_; }
  /// Back to paintPlane().
  void dropVtk();
  /// Paints and draws again, soon.
  void refresh();

  QSizeF fit() const;     // widget pixels a plane's pixel where the plane just fits, across and down
  QRectF target() const;  // where the whole plane lies
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
  /// Only what stands over the plane has changed.
  void refreshWords();
  void paintWords(QPainter& painter);
  void paintMarks(QPainter& painter);
  void paintPick(QPainter& painter);
  void paintScaleBar(QPainter& painter);

  ViewLink own_;
  ViewLink* link_ = &own_;
  VtkView* vtk_ = nullptr;
  Glass* glass_ = nullptr;
  QPointer<QWidget> whole_;
  QString emptyText_, badge_, caption_;
  bool scaleBar_ = false, dragging_ = false;
  bool saving_ = false;  // what belongs to the program, corners and focus, is left out
  Readout readout_;
  QPointF pressed_, lastDrag_;
  std::optional<QPoint> hovered_;
};

}  // namespace relucent
