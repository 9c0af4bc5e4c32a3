// SPDX-License-Identifier: MIT
#include "desktop/wayland_window.h"

#include <qpa/qplatformnativeinterface.h>
#include <wayland-client.h>

#include <QGuiApplication>
#include <QScreen>
#include <utility>

#include "desktop/wayland_compositor.h"
#include "protocols/idle-inhibit-unstable-v1.h"
#include "protocols/viewporter.h"

namespace relucent::gui {

QSize drawnSize(const QWindow& window) {
  return (QSizeF(window.size()) * window.devicePixelRatio()).toSize();
}

std::optional<ExactCrop> cropOf(const QWindow& window) {
  WaylandCompositor* const compositor = WaylandCompositor::instance();
  if (compositor == nullptr || compositor->viewporter() == nullptr || window.screen() == nullptr) return {};
  const QSize mode = compositor->pixelsOf(*window.screen());
  const QSize logical = window.screen()->geometry().size(), drawn = drawnSize(window);
  if (mode.isEmpty() || mode == drawn || window.size() != logical) return {};
  return exactCrop(mode, logical, drawn);
}

bool canBeExactOn(const QScreen& screen) {
  WaylandCompositor* const compositor = WaylandCompositor::instance();
  const QSize mode = compositor != nullptr ? compositor->pixelsOf(screen) : QSize();
  const QSize logical = screen.geometry().size();
  const QSize drawn = (QSizeF(logical) * screen.devicePixelRatio()).toSize();
  if (mode.isEmpty() || mode == drawn) return true;
  return compositor->viewporter() != nullptr && exactCrop(mode, logical, drawn);
}

void WaylandWindow::prepare() {
  WaylandCompositor* const compositor = WaylandCompositor::instance();
  if (compositor == nullptr) return;
  auto* const surface = static_cast<wl_surface*>(
      QGuiApplication::platformNativeInterface()->nativeResourceForWindow("surface", &window_));
  if (surface == nullptr) return;
  if (surface != surface_) forget();
  surface_ = surface;
  if (awake_ == nullptr && compositor->idleInhibitor() != nullptr)
    awake_ = zwp_idle_inhibit_manager_v1_create_inhibitor(compositor->idleInhibitor(), surface);
  const std::optional<ExactCrop> crop = cropOf(window_);
  if (!crop) {
    if (viewport_ != nullptr) wp_viewport_destroy(std::exchange(viewport_, nullptr));
    return;
  }
  if (viewport_ == nullptr) viewport_ = wp_viewporter_get_viewport(compositor->viewporter(), surface);
  // Of the surface as its buffer's scale makes it.
  const auto part = [&](int pixels) { return wl_fixed_from_double(pixels / window_.devicePixelRatio()); };
  wp_viewport_set_source(viewport_, 0, 0, part(crop->pixels.width()), part(crop->pixels.height()));
  wp_viewport_set_destination(viewport_, crop->place.width(), crop->place.height());
}

void WaylandWindow::forget() {
  if (viewport_ != nullptr) wp_viewport_destroy(std::exchange(viewport_, nullptr));
  if (awake_ != nullptr) zwp_idle_inhibitor_v1_destroy(std::exchange(awake_, nullptr));
  surface_ = nullptr;
}

}  // namespace relucent::gui
