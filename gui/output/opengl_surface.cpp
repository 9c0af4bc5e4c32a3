// SPDX-License-Identifier: MIT
#include "output/opengl_surface.h"

#include <QOffscreenSurface>
#include <QOpenGLFunctions>
#include <algorithm>
#include <utility>

#include "desktop/wayland_window.h"
#include "output/shared_gl.h"

namespace relucent::gui {

OpenGlSurface::OpenGlSurface(QWindow& window) : window_(window) {
  window_.setSurfaceType(QSurface::OpenGLSurface);
}

OpenGlSurface::~OpenGlSurface() {
  forget();
}

void OpenGlSurface::forget() {
  if (context_ == nullptr) return;
  // Under Wayland a hidden window has nothing to draw on.
  QOffscreenSurface instead;
  if (!context_->makeCurrent(&window_)) {
    instead.setFormat(context_->format());
    instead.create();
    context_->makeCurrent(&instead);
  }
  picture_ = {};
  overlay_ = {};
  blitter_.destroy();
  context_.reset();
}

/// With a new context where the old one was lost, as it is when the graphics card was reset.
bool OpenGlSurface::begin() {
  if (context_ != nullptr && context_->makeCurrent(&window_)) return true;
  forget();
  SharedGl* const shared = SharedGl::existing();
  context_ = std::make_unique<QOpenGLContext>();
  context_->setFormat(window_.requestedFormat());
  context_->setScreen(window_.screen());
  if (shared != nullptr) context_->setShareContext(shared->root());
  if (!context_->create() || !context_->makeCurrent(&window_) || !blitter_.create()) return false;
  isSharing_ = shared != nullptr && QOpenGLContext::areSharing(context_.get(), shared->root());
  return true;
}

void OpenGlSurface::Upload::take(const QImage& picture) {
  if (std::exchange(key, picture.cacheKey()) == picture.cacheKey()) return;
  if (picture.isNull()) {
    texture.reset();
    return;
  }
  QImage pixels = picture.convertToFormat(QImage::Format_RGBA8888);
  if (texture == nullptr || texture->width() != pixels.width() || texture->height() != pixels.height()) {
    texture = std::make_unique<QOpenGLTexture>(QOpenGLTexture::Target2D);
    texture->setFormat(QOpenGLTexture::RGBA8_UNorm);
    texture->setSize(pixels.width(), pixels.height());
    texture->setMinMagFilters(QOpenGLTexture::Nearest, QOpenGLTexture::Nearest);
    texture->setWrapMode(QOpenGLTexture::ClampToEdge);
    texture->allocateStorage(QOpenGLTexture::RGBA, QOpenGLTexture::UInt8);
  }
  texture->setData(QOpenGLTexture::RGBA, QOpenGLTexture::UInt8, pixels.constBits());
}

/// 0: black.
unsigned OpenGlSurface::textureOf(const DrivePicture& picture) {
  const CardPicture* card = picture.card();
  if (card != nullptr && isSharing_) return card->texture();
  // Where drivers do not share, what is on the card goes through memory; it is drawn once.
  picture_.take(picture.image());
  return picture_.name();
}

void OpenGlSurface::draw(const DrivePicture& picture, const QImage& overlay) {
  if (!begin()) return;
  QOpenGLFunctions* gl = context_->functions();
  QSize native = nativeSize(window_);
  // Its upper left part, where Qt draws more than the display has; OpenGL counts from below.
  gl->glViewport(0, std::max(0, drawnSize(window_).height() - native.height()), native.width(),
                 native.height());
  gl->glDisable(GL_BLEND);
  gl->glDisable(GL_DITHER);
  gl->glClearColor(0.0f, 0.0f, 0.0f, 1.0f);
  gl->glClear(GL_COLOR_BUFFER_BIT);
  const QRect place = middleOf(native, picture.isNull() ? native : picture.size());
  overlay_.take(overlay);
  blitter_.bind();
  const auto blit = [&](unsigned texture, const QRect& at) {
    if (texture == 0) return;
    blitter_.blit(texture, QOpenGLTextureBlitter::targetTransform(QRectF(at), QRect(QPoint(), native)),
                  QOpenGLTextureBlitter::OriginTopLeft);
  };
  blit(textureOf(picture), place);
  blit(overlay_.name(), {place.topLeft(), overlay.size()});
  blitter_.release();
  context_->swapBuffers(&window_);
  drawn_ = picture;
}

}  // namespace relucent::gui
