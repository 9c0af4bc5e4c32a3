// SPDX-License-Identifier: MIT
#include "output/window_surface.h"

#include <QOffscreenSurface>
#include <QOpenGLContext>

#include "output/opengl_surface.h"
#include "output/raster_surface.h"
#include "output/screen_identity.h"

namespace relucent::gui {
namespace {

bool foundOpenGl() {
  QOffscreenSurface surface;
  surface.create();
  // Asked first: Qt ends the program that wants a context of an X server whose GLX has no driver here.
  if (!surface.isValid()) return false;
  QOpenGLContext context;
  return context.create() && context.makeCurrent(&surface);
}

}  // namespace

std::unique_ptr<WindowSurface> surfaceFor(QWindow& window) {
  static const bool hasOpenGl = foundOpenGl();
  if (hasOpenGl) return std::make_unique<OpenGlSurface>(window);
  return std::make_unique<RasterSurface>(window);
}

QSize nativeSize(const QWindow& window) {
  return nativeSize(window.size(), window.devicePixelRatio());
}

QRect middleOf(QSize window, QSize picture) {
  return {QPoint((window.width() - picture.width()) / 2, (window.height() - picture.height()) / 2), picture};
}

}  // namespace relucent::gui
