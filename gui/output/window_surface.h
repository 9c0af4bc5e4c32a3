// SPDX-License-Identifier: MIT
#pragma once

#include <QImage>
#include <QRect>
#include <QWindow>
#include <memory>

#include "output/drive_picture.h"

namespace relucent::gui {

/// Draws a projector's window. Created before the window is shown and destroyed before the window.
class WindowSurface {
 public:
  virtual ~WindowSurface() = default;
  /// For log and health file.
  virtual QString name() const = 0;
  /// Whether draw() waits for the display, as far as the driver permits; otherwise it returns while the
  /// display still shows the previous picture.
  virtual bool keepsStep() const = 0;
  /// Draws the whole window: the picture centred pixel for pixel, black around it; a null picture is black.
  /// `overlay`: lies over the picture's upper left corner; null: none.
  virtual void draw(const DrivePicture& picture, const QImage& overlay) = 0;
};

/// Whether there is OpenGL, and whether a graphics card draws it. First called on the windows' thread.
bool hasOpenGl();
bool hasGraphicsCard();

/// By OpenGL, or in memory if that is not available.
std::unique_ptr<WindowSurface> surfaceFor(QWindow& window);

/// A window's size in its display's physical pixels: the upper left part of what Qt draws for it, if that is
/// more (desktop/exact_crop.h).
QSize nativeSize(const QWindow& window);
/// Position of a picture in a window: aligned to the display's pixels, an odd remainder at the right and
/// bottom.
QRect middleOf(QSize window, QSize picture);

}  // namespace relucent::gui
