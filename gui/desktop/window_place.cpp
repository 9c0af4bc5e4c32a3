// SPDX-License-Identifier: MIT
#include "desktop/window_place.h"

#include <xcb/xcb.h>

#include <QGuiApplication>
#include <QScreen>
#include <cstdlib>

#include "desktop/xcb_reply.h"

namespace relucent::gui {
namespace {

/// Where the X server has it now, in pixels; empty: it has none.
QRect placeOnX(xcb_connection_t* x, xcb_window_t window) {
  auto shape = owned(xcb_get_geometry_reply(x, xcb_get_geometry(x, window), nullptr));
  if (!shape) return {};
  auto corner = owned(
      xcb_translate_coordinates_reply(x, xcb_translate_coordinates(x, window, shape->root, 0, 0), nullptr));
  if (!corner) return {};
  return {corner->dst_x, corner->dst_y, shape->width, shape->height};
}

bool isAt(const QRect& wanted, const QRect& found) {
  const QSize off = wanted.size() - found.size();
  return wanted.topLeft() == found.topLeft() && std::abs(off.width()) <= 1 && std::abs(off.height()) <= 1;
}

}  // namespace

bool standsOn(const QWindow& window, const QScreen& screen, const QRect& place) {
  // Where there is no display at all, Qt has the interface too, without a server behind it.
  const auto* x = qGuiApp->nativeInterface<QNativeInterface::QX11Application>();
  if (x != nullptr && QGuiApplication::platformName() == "xcb")
    return isAt(place, placeOnX(x->connection(), static_cast<xcb_window_t>(window.winId())));
  return window.screen() == &screen;
}

}  // namespace relucent::gui
