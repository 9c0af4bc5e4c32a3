// SPDX-License-Identifier: MIT
#include "output/window_surface.h"

#include <QOffscreenSurface>
#include <QOpenGLContext>
#include <QOpenGLFunctions>
#include <string>

#include "desktop/wayland_window.h"
#include "output/opengl_surface.h"
#include "output/raster_surface.h"
#include "output/screen_identity.h"
#include "relucent/engine/gl_host.h"

namespace relucent::gui {
namespace {

/// Its device; empty: there is none.
std::string deviceOfOpenGl() {
  QOffscreenSurface surface;
  surface.create();
  // Asked first: Qt ends the program that wants a context of an X server whose GLX has no driver here.
  if (!surface.isValid()) return {};
  QOpenGLContext context;
  if (!context.create() || !context.makeCurrent(&surface)) return {};
  const GLubyte* name = context.functions()->glGetString(GL_RENDERER);
  return name != nullptr ? reinterpret_cast<const char*>(name) : "unknown";
}

const std::string& device() {
  static const std::string found = deviceOfOpenGl();
  return found;
}

}  // namespace

bool hasOpenGl() {
  return !device().empty();
}

bool hasGraphicsCard() {
  return hasOpenGl() && !engine::isSoftwareRenderer(device());
}

std::unique_ptr<WindowSurface> surfaceFor(QWindow& window) {
  if (hasOpenGl()) return std::make_unique<OpenGlSurface>(window);
  return std::make_unique<RasterSurface>(window);
}

QSize nativeSize(const QWindow& window) {
  if (cropOf(window)) return nativeSize(*window.screen());
  return nativeSize(window.size(), window.devicePixelRatio());
}

QRect middleOf(QSize window, QSize picture) {
  return {QPoint((window.width() - picture.width()) / 2, (window.height() - picture.height()) / 2), picture};
}

}  // namespace relucent::gui
