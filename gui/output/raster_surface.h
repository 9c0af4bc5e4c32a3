// SPDX-License-Identifier: MIT
#pragma once

#include <QBackingStore>

#include "output/window_surface.h"

namespace relucent::gui {

/// Draws pictures in memory for the display server: for computers without OpenGL.
class RasterSurface : public WindowSurface {
 public:
  explicit RasterSurface(QWindow& window);

  QString name() const override { return "memory"; }
  bool keepsStep() const override { return false; }
  void draw(const DrivePicture& drive, const QImage& overlay) override;

 private:
  QWindow& window_;
  QBackingStore store_;
};

}  // namespace relucent::gui
