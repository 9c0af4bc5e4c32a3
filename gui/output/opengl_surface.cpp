// SPDX-License-Identifier: MIT
#include "output/opengl_surface.h"

#include <QOpenGLFunctions>
#include <utility>

namespace relucent::gui {

OpenGlSurface::OpenGlSurface(QWindow& window) : window_(window) {
  window_.setSurfaceType(QSurface::OpenGLSurface);
}

OpenGlSurface::~OpenGlSurface() {
  forget();
}

void OpenGlSurface::forget() {
  if (context_ == nullptr) return;
  context_->makeCurrent(&window_);
  texture_.reset();
  blitter_.destroy();
  context_.reset();
  uploaded_ = 0;
}

/// With a new context where the old one was lost, as it is when the graphics card was reset.
bool OpenGlSurface::begin() {
  if (context_ != nullptr && context_->makeCurrent(&window_)) return true;
  forget();
  context_ = std::make_unique<QOpenGLContext>();
  context_->setFormat(window_.requestedFormat());
  context_->setScreen(window_.screen());
  return context_->create() && context_->makeCurrent(&window_) && blitter_.create();
}

void OpenGlSurface::upload(const QImage& picture) {
  if (std::exchange(uploaded_, picture.cacheKey()) == picture.cacheKey()) return;
  if (picture.isNull()) {
    texture_.reset();
    return;
  }
  QImage pixels = picture.convertToFormat(QImage::Format_RGBA8888);
  if (texture_ == nullptr || texture_->width() != pixels.width() || texture_->height() != pixels.height()) {
    texture_ = std::make_unique<QOpenGLTexture>(QOpenGLTexture::Target2D);
    texture_->setFormat(QOpenGLTexture::RGBA8_UNorm);
    texture_->setSize(pixels.width(), pixels.height());
    texture_->setMinMagFilters(QOpenGLTexture::Nearest, QOpenGLTexture::Nearest);
    texture_->setWrapMode(QOpenGLTexture::ClampToEdge);
    texture_->allocateStorage(QOpenGLTexture::RGBA, QOpenGLTexture::UInt8);
  }
  texture_->setData(QOpenGLTexture::RGBA, QOpenGLTexture::UInt8, pixels.constBits());
}

void OpenGlSurface::draw(const QImage& picture) {
  if (!begin()) return;
  QOpenGLFunctions* gl = context_->functions();
  QSize native = nativeSize(window_);
  gl->glViewport(0, 0, native.width(), native.height());
  gl->glDisable(GL_BLEND);
  gl->glDisable(GL_DITHER);
  gl->glClearColor(0.0f, 0.0f, 0.0f, 1.0f);
  gl->glClear(GL_COLOR_BUFFER_BIT);
  upload(picture);
  if (texture_ != nullptr) {
    QRect place = middleOf(native, picture.size());
    blitter_.bind();
    blitter_.blit(texture_->textureId(),
                  QOpenGLTextureBlitter::targetTransform(QRectF(place), QRect(QPoint(), native)),
                  QOpenGLTextureBlitter::OriginTopLeft);
    blitter_.release();
  }
  context_->swapBuffers(&window_);
}

}  // namespace relucent::gui
