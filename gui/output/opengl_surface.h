// SPDX-License-Identifier: MIT
#pragma once

#include <QOpenGLContext>
#include <QOpenGLTexture>
#include <QOpenGLTextureBlitter>
#include <memory>

#include "output/window_surface.h"

namespace relucent::gui {

/// Draws pictures as textures, swapped at the display's refresh.
class OpenGlSurface : public WindowSurface {
 public:
  explicit OpenGlSurface(QWindow& window);
  ~OpenGlSurface() override;

  QString name() const override { return "OpenGL"; }
  bool keepsStep() const override { return true; }
  void draw(const QImage& picture) override;

 private:
  bool begin();
  void forget();
  void upload(const QImage& picture);

  QWindow& window_;
  std::unique_ptr<QOpenGLContext> context_;
  qint64 uploaded_ = 0;  // the picture's key
  std::unique_ptr<QOpenGLTexture> texture_;
  QOpenGLTextureBlitter blitter_;
};

}  // namespace relucent::gui
