// SPDX-License-Identifier: MIT
#pragma once

#include <QImage>
#include <QTimer>
#include <QWindow>
#include <memory>

#include "output/screen_identity.h"
#include "output/window_surface.h"

namespace relucent {

/// What one projector shows: full screen on its display, pixel for pixel, black until it is given a picture.
/// When its display goes, the window hides, as the desktop would else move it to the operator's screen; when
/// the display comes back it shines again. Drawn by OpenGL in step with the display; without it where there
/// is none, and then no more often than the display shows pictures.
class ProjectorWindow : public QWindow {
  Q_OBJECT

 public:
  explicit ProjectorWindow(ScreenIdentity display, QWindow* parent = nullptr);
  ~ProjectorWindow() override;

  const ScreenIdentity& display() const { return display_; }
  /// What it is drawn with.
  const WindowSurface& surface() const { return *surface_; }
  /// Goes full screen on its display; waits for it if it is not there.
  void shine();
  /// Hides, and stays hidden when the display comes back.
  void stop();
  /// Whether it is on its display now.
  bool isShining() const;
  /// Its display's size in pixels; empty while it is not there.
  QSize displaySize() const;

  /// Shows drive values from the next swap on. Of another size than the display they stay as they are, in the
  /// middle: never scaled.  Shape: the display's, 8 bits a channel.
  void present(const QImage& drive);
  /// Black, until the next picture.
  void blacken();
  /// Draws once more what stands, soon.
  void update();

 Q_SIGNALS:
  /// What was presented last is out: swapped, or so long with the display server that the display has it.
  void frameSwapped();
  /// The display was unplugged or switched off: nothing of this window is visible anywhere.
  void displayLost();
  /// The display is back and the window on it.
  void displayFound();
  /// The display has another place or resolution; the window has followed.
  void displayChanged();
  /// A key that somebody pressed at the projector's own window.
  void keyPressed(int key, Qt::KeyboardModifiers modifiers);

 protected:
  bool event(QEvent* event) override;
  void exposeEvent(QExposeEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;

 private:
  void screenGone(QScreen* screen);
  void screenCame();
  void goTo(QScreen* screen);
  void follow();
  void draw();
  void drawn();

  ScreenIdentity display_;
  bool wanted_ = false;
  QScreen* on_ = nullptr;  // where it shines; nullptr while it does not
  QImage picture_;
  bool fresh_ = false;  // not drawn yet
  std::unique_ptr<WindowSurface> surface_;
  QTimer refreshing_;  // of the display, where drawing does not wait for it
};

}  // namespace relucent
