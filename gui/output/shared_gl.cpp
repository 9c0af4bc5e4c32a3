// SPDX-License-Identifier: MIT
#include "output/shared_gl.h"

#include <QThread>
#include <atomic>
#include <utility>

#include "output/window_surface.h"

namespace relucent::gui {
namespace {

/// What the engine's programs need.
QSurfaceFormat formatForComputing() {
  QSurfaceFormat format;
  format.setVersion(4, 3);
  format.setProfile(QSurfaceFormat::CoreProfile);
  return format;
}

std::atomic<SharedGl*> only = nullptr;

}  // namespace

/// A context that belongs to no thread while it is not current.
class SharedGl::Host : public engine::GlHost {
 public:
  explicit Host(QOpenGLContext& root) {
    surface_->setFormat(formatForComputing());
    surface_->create();
    context_.setFormat(formatForComputing());
    context_.setShareContext(&root);
    isOpen_ = context_.create() && QOpenGLContext::areSharing(&context_, &root);
    context_.moveToThread(nullptr);
  }
  ~Host() override {
    context_.moveToThread(QThread::currentThread());
    // A surface ends where it was made.
    surface_.release()->deleteLater();
  }
  Host(const Host&) = delete;
  Host& operator=(const Host&) = delete;

  bool isOpen() const { return isOpen_; }
  QOpenGLContext& context() { return context_; }
  bool makeCurrent() noexcept override {
    context_.moveToThread(QThread::currentThread());
    if (isOpen_ && context_.makeCurrent(surface_.get())) return true;
    context_.moveToThread(nullptr);
    return false;
  }
  void doneCurrent() noexcept override {
    context_.doneCurrent();
    context_.moveToThread(nullptr);
  }

 private:
  std::unique_ptr<QOffscreenSurface> surface_ = std::make_unique<QOffscreenSurface>();
  QOpenGLContext context_;
  bool isOpen_ = false;
};

SharedGl* SharedGl::instance() {
  static const bool isMade = [] {
    auto made = std::unique_ptr<SharedGl>(new SharedGl);
    // It stays as long as the program: textures may end with the last of its objects.
    if (made->open()) only = made.release();
    return only != nullptr;
  }();
  return isMade ? only.load() : nullptr;
}

SharedGl* SharedGl::existing() {
  return only;
}

bool SharedGl::open() {
  if (!hasOpenGl() || !root_.create()) return false;
  worker_ = std::make_unique<Host>(root_);
  return worker_->isOpen();
}

std::unique_ptr<engine::GlHost> SharedGl::host() {
  auto host = std::make_unique<Host>(root_);
  return host->isOpen() ? std::move(host) : nullptr;
}

bool SharedGl::run(const std::function<void(QOpenGLContext& context)>& work) {
  QMutexLocker lock(&guard_);
  QOpenGLContext* const before = QOpenGLContext::currentContext();
  QSurface* const surface = before != nullptr ? before->surface() : nullptr;
  if (!worker_->makeCurrent()) return false;
  work(worker_->context());
  worker_->doneCurrent();
  if (before != nullptr) before->makeCurrent(surface);
  return true;
}

}  // namespace relucent::gui
