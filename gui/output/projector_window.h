// SPDX-License-Identifier: MIT
#pragma once

#include <QImage>
#include <QOpenGLTexture>
#include <QOpenGLTextureBlitter>
#include <QOpenGLWindow>
#include <memory>

#include "output/screen_identity.h"

namespace relucent {

/// What one projector shows: full screen on its display, pixel for pixel, black until it is given a picture.
/// When its display goes, the window hides, as the desktop would else move it to the operator's screen; when
/// the display comes back it shines again.
class ProjectorWindow : public QOpenGLWindow {
  Q_OBJECT

 public:
  explicit ProjectorWindow(ScreenIdentity display, QWindow* parent = nullptr);
  ~ProjectorWindow() override;

  const ScreenIdentity& display() const { return display_; }
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

 Q_SIGNALS:
  /// The display was unplugged or switched off: nothing of this window is visible anywhere.
  void displayLost();
  /// The display is back and the window on it.
  void displayFound();
  /// The display has another place or resolution; the window has followed.
  void displayChanged();
  /// A key that somebody pressed at the projector's own window.
  void keyPressed(int key, Qt::KeyboardModifiers modifiers);

 protected:
  void initializeGL() override;
  void paintGL() override;
  void keyPressEvent(QKeyEvent* event) override;

 private:
  void screenGone(QScreen* screen);
  void screenCame();
  void goTo(QScreen* screen);
  void follow();
  void forgetGraphics();
  void upload();

  ScreenIdentity display_;
  bool wanted_ = false;
  QScreen* on_ = nullptr;  // where it shines; nullptr while it does not
  QImage picture_;
  bool fresh_ = false;  // not uploaded yet
  std::unique_ptr<QOpenGLTexture> texture_;
  std::unique_ptr<QOpenGLTextureBlitter> blitter_;
};

}  // namespace relucent
