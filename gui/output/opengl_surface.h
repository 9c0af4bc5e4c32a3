// SPDX-License-Identifier: MIT
#pragma once

#include <QOpenGLContext>
#include <QOpenGLTexture>
#include <QOpenGLTextureBlitter>
#include <memory>

#include "output/window_surface.h"

namespace relucent::gui {

/// Draws pictures as textures, swapped at the display's refresh. Those on the graphics card already are drawn
/// from there.
class OpenGlSurface : public WindowSurface {
 public:
  explicit OpenGlSurface(QWindow& window);
  ~OpenGlSurface() override;

  QString name() const override { return "OpenGL"; }
  bool keepsStep() const override { return true; }
  void draw(const DrivePicture& picture, const QImage& overlay) override;
  /// Pictures of the card are drawn from there, not through memory.
  bool isSharing() const { return isSharing_; }

 private:
  bool begin();
  void forget();
  /// A picture in memory that becomes a texture when it is another than before.
  struct Upload {
    qint64 key = 0;  // the picture's
    std::unique_ptr<QOpenGLTexture> texture;

    void take(const QImage& picture);
    unsigned name() const { return texture ? texture->textureId() : 0; }
  };
  unsigned textureOf(const DrivePicture& picture);

  QWindow& window_;
  std::unique_ptr<QOpenGLContext> context_;
  bool isSharing_ = false;  // textures with SharedGl
  Upload picture_, overlay_;
  DrivePicture drawn_;  // kept until another one is drawn
  QOpenGLTextureBlitter blitter_;
};

}  // namespace relucent::gui
