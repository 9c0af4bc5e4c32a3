// SPDX-License-Identifier: MIT
#pragma once

#include <QElapsedTimer>
#include <QImage>
#include <QTimer>
#include <QWindow>
#include <memory>

#include "desktop/wayland_window.h"
#include "output/screen_identity.h"
#include "output/window_surface.h"

namespace relucent::gui {

/// The window of one projector: full screen on its display, pixel for pixel, black until it gets a picture.
/// When its display disappears the window hides, since the desktop would otherwise move it to the operator's
/// screen; when the display returns it is shown again. It stays black until the display server says that it
/// stands on its display, leaves at once when the desktop puts it elsewhere, and tries again later. Drawn by
/// OpenGL in sync with the display, or without it, then at most at the display's rate.
class ProjectorWindow : public QWindow {
  Q_OBJECT

 public:
  explicit ProjectorWindow(ScreenIdentity display, QWindow* parent = nullptr);
  ~ProjectorWindow() override;

  const ScreenIdentity& display() const { return display_; }
  /// How it is drawn.
  const WindowSurface& surface() const { return *surface_; }
  /// Its keys are for where its display hides the windows that are operated; where it does not, they are
  /// left to those. As the windows stand now; before it is shown.
  void takeKeysOnlyIfAlone();
  /// Light that is photographed: while it is wanted, another window that comes to its display waits until it
  /// has gone, however late the desktop lets either back. What shone there before stays behind it.
  void comeFirst() { isFirst_ = true; }
  /// A projector's window shines on that display now.
  static bool isTaken(const ScreenIdentity& display);
  /// Shows itself full screen on its display, and waits for it if it is absent.
  void shine();
  /// Hides, and stays hidden when the display returns.
  void stop();
  /// Whether it is on its display now.
  bool isShining() const;
  /// The screen where the desktop had put it instead when it left last; empty: it did not.
  const QString& elsewhere() const { return elsewhere_; }
  /// Its display's size in pixels; empty while it is absent.
  QSize displaySize() const;

  /// Shows drive values from the next swap on. If their size differs from the display's they are centred,
  /// never scaled.  Shape: the display's, 8 bits a channel. `overlay`: over their upper left corner.
  void present(const DrivePicture& drive, const QImage& overlay = {});
  /// Black, until the next picture.
  void blacken();
  /// Schedules a repaint of the present picture.
  void update();

 Q_SIGNALS:
  /// The last picture is displayed: swapped, or with the display server long enough.
  void frameSwapped();
  /// The display was unplugged or switched off, or the desktop had put the window elsewhere(): it is not
  /// visible anywhere.
  void displayLost();
  /// The display is back with the window on it.
  void displayFound();
  /// The display's position or resolution has changed; the window has followed.
  void displayChanged();
  /// A key was pressed at the projector's window.
  void keyPressed(int key, Qt::KeyboardModifiers modifiers);
  /// The mouse was moved on it with its left button held: by so much to the right and up, as shares of the
  /// window's width and height.
  void dragged(double right, double up);

 protected:
  bool event(QEvent* event) override;
  void exposeEvent(QExposeEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void moveEvent(QMoveEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;

 private:
  void screenGone(QScreen* screen);
  void screenCame();
  bool waitsFor(const QScreen* screen) const;
  void letOthersCome();
  void goTo(QScreen* screen);
  void vanish();
  void follow();
  bool stands() const;
  void look();
  void doubt();
  void prove();
  void leave();
  void draw();
  void drawn();

  ScreenIdentity display_;
  QPointF mouse_;  // where it was last seen with its button held
  bool wanted_ = false;
  bool isFirst_ = false;
  QScreen* on_ = nullptr;  // where it is shown; nullptr while hidden
  bool proven_ = false;    // to stand there
  int swaps_ = 0;          // of black, since that was doubted
  QElapsedTimer doubted_;
  bool lost_ = false;  // and not found since
  QString elsewhere_;
  QTimer returning_;  // from elsewhere
  int returns_ = 0;
  WaylandWindow onWayland_;
  DrivePicture picture_;
  QImage overlay_;
  bool fresh_ = false;  // not drawn yet
  std::unique_ptr<WindowSurface> surface_;
  QTimer refreshing_;  // refresh time, where drawing does not wait for the display
};

}  // namespace relucent::gui
