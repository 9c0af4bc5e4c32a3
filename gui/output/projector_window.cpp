// SPDX-License-Identifier: MIT
#include "output/projector_window.h"

#include <QGuiApplication>
#include <QKeyEvent>
#include <QOpenGLContext>
#include <QOpenGLFunctions>
#include <QScreen>
#include <utility>

namespace relucent {

ProjectorWindow::ProjectorWindow(ScreenIdentity display, QWindow* parent)
    : QOpenGLWindow(NoPartialUpdate, parent), display_(std::move(display)) {
  setFlags(Qt::Window | Qt::FramelessWindowHint | Qt::WindowStaysOnTopHint);
  setCursor(Qt::BlankCursor);
  setTitle(display_.connector);
  connect(qGuiApp, &QGuiApplication::screenRemoved, this, &ProjectorWindow::screenGone);
  connect(qGuiApp, &QGuiApplication::screenAdded, this, &ProjectorWindow::screenCame);
}

ProjectorWindow::~ProjectorWindow() {
  makeCurrent();
  forgetGraphics();
  doneCurrent();
}

void ProjectorWindow::shine() {
  wanted_ = true;
  if (QScreen* screen = findScreen(display_)) goTo(screen);
}

void ProjectorWindow::stop() {
  wanted_ = false;
  on_ = nullptr;
  hide();
}

bool ProjectorWindow::isShining() const {
  return on_ != nullptr && isVisible();
}

QSize ProjectorWindow::displaySize() const {
  const QScreen* screen = findScreen(display_);
  return screen ? nativeSize(*screen) : QSize();
}

void ProjectorWindow::present(const QImage& drive) {
  picture_ = drive;
  fresh_ = true;
  update();
}

void ProjectorWindow::blacken() {
  present(QImage());
}

void ProjectorWindow::goTo(QScreen* screen) {
  on_ = screen;
  connect(screen, &QScreen::geometryChanged, this, &ProjectorWindow::follow, Qt::UniqueConnection);
  setScreen(screen);
  setGeometry(screen->geometry());
  // showFullScreen() would ask for the keys, too.
  setWindowStates(Qt::WindowFullScreen);
  setVisible(true);
  if (!flags().testFlag(Qt::WindowDoesNotAcceptFocus)) requestActivate();
  fresh_ = true;
  update();
}

void ProjectorWindow::follow() {
  if (on_ == nullptr || geometry() == on_->geometry()) return;
  setGeometry(on_->geometry());
  Q_EMIT displayChanged();
}

void ProjectorWindow::screenGone(QScreen* screen) {
  if (screen != on_) return;
  on_ = nullptr;
  hide();
  Q_EMIT displayLost();
}

void ProjectorWindow::screenCame() {
  if (!wanted_ || on_ != nullptr) return;
  QScreen* screen = findScreen(display_);
  if (screen == nullptr) return;
  goTo(screen);
  Q_EMIT displayFound();
}

void ProjectorWindow::initializeGL() {
  connect(context(), &QOpenGLContext::aboutToBeDestroyed, this, [this] {
    makeCurrent();
    forgetGraphics();
    doneCurrent();
  });
  blitter_ = std::make_unique<QOpenGLTextureBlitter>();
  blitter_->create();
  fresh_ = true;
}

void ProjectorWindow::forgetGraphics() {
  texture_.reset();
  if (blitter_) blitter_->destroy();
  blitter_.reset();
}

void ProjectorWindow::upload() {
  fresh_ = false;
  if (picture_.isNull()) {
    texture_.reset();
    return;
  }
  QImage pixels = picture_.convertToFormat(QImage::Format_RGBA8888);
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

void ProjectorWindow::paintGL() {
  QOpenGLFunctions* gl = context()->functions();
  QSize native = (QSizeF(size()) * devicePixelRatio()).toSize();
  gl->glViewport(0, 0, native.width(), native.height());
  gl->glDisable(GL_BLEND);
  gl->glDisable(GL_DITHER);
  gl->glClearColor(0.0f, 0.0f, 0.0f, 1.0f);
  gl->glClear(GL_COLOR_BUFFER_BIT);
  if (fresh_) upload();
  if (texture_ == nullptr || blitter_ == nullptr) return;
  // Whole pixels of the display, the odd one to the right and below.
  QRect place(QPoint((native.width() - texture_->width()) / 2, (native.height() - texture_->height()) / 2),
              QSize(texture_->width(), texture_->height()));
  blitter_->bind();
  blitter_->blit(texture_->textureId(),
                 QOpenGLTextureBlitter::targetTransform(QRectF(place), QRect(QPoint(), native)),
                 QOpenGLTextureBlitter::OriginTopLeft);
  blitter_->release();
}

void ProjectorWindow::keyPressEvent(QKeyEvent* event) {
  Q_EMIT keyPressed(event->key(), event->modifiers());
}

}  // namespace relucent
