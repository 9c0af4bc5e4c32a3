// SPDX-License-Identifier: MIT
#pragma once

#include <QImage>
#include <QRect>
#include <QWindow>
#include <memory>

namespace relucent {

/// What a projector's window is drawn with. Made before the window is shown and gone before it is.
class WindowSurface {
 public:
  virtual ~WindowSurface() = default;
  /// For log and health file.
  virtual QString name() const = 0;
  /// Whether draw() waits for the display, as far as the driver lets it; else it returns while the display
  /// still sends what was there before.
  virtual bool keepsStep() const = 0;
  /// Draws the whole window: the picture pixel for pixel in its middle, black around it; a null one is black.
  virtual void draw(const QImage& picture) = 0;
};

/// By OpenGL; in memory where that cannot be had.
std::unique_ptr<WindowSurface> surfaceFor(QWindow& window);

/// A window's size in its display's own pixels.
QSize nativeSize(const QWindow& window);
/// Where a picture lies in a window: on whole pixels of the display, the odd one to the right and below.
QRect middleOf(QSize window, QSize picture);

}  // namespace relucent
