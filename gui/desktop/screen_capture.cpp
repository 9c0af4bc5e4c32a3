// SPDX-License-Identifier: MIT
#include "desktop/screen_capture.h"

#include <xcb/randr.h>
#include <xcb/xcb.h>

#include <QCoreApplication>
#include <cstdint>
#include <utility>

#include "desktop/xcb_reply.h"

namespace relucent::gui {
namespace {

using Screen = ScreenCapture::Screen;
using Window = ScreenCapture::Window;

std::vector<Screen> screensOf(xcb_connection_t* x, xcb_window_t root) {
  auto resources = owned(xcb_randr_get_screen_resources_current_reply(
      x, xcb_randr_get_screen_resources_current(x, root), nullptr));
  std::vector<Screen> found;
  if (!resources) return found;
  const xcb_randr_output_t* outputs = xcb_randr_get_screen_resources_current_outputs(resources.get());
  for (int i = 0; i < resources->num_outputs; ++i) {
    auto info = owned(xcb_randr_get_output_info_reply(
        x, xcb_randr_get_output_info(x, outputs[i], resources->config_timestamp), nullptr));
    if (!info) continue;
    Screen screen;
    screen.name = QString::fromUtf8(reinterpret_cast<const char*>(xcb_randr_get_output_info_name(info.get())),
                                    xcb_randr_get_output_info_name_length(info.get()));
    if (info->crtc != XCB_NONE) {
      auto crtc = owned(xcb_randr_get_crtc_info_reply(
          x, xcb_randr_get_crtc_info(x, info->crtc, resources->config_timestamp), nullptr));
      if (crtc) screen.place = {crtc->x, crtc->y, crtc->width, crtc->height};
    }
    found.push_back(screen);
  }
  return found;
}

xcb_atom_t atomOf(xcb_connection_t* x, const QByteArray& name) {
  auto atom = owned(xcb_intern_atom_reply(
      x, xcb_intern_atom(x, 0, static_cast<std::uint16_t>(name.size()), name.constData()), nullptr));
  return atom ? atom->atom : static_cast<xcb_atom_t>(XCB_NONE);
}

QString titleOf(xcb_connection_t* x, xcb_window_t window, xcb_atom_t netName) {
  for (xcb_atom_t atom : {netName, static_cast<xcb_atom_t>(XCB_ATOM_WM_NAME)}) {
    auto property = owned(xcb_get_property_reply(
        x, xcb_get_property(x, 0, window, atom, XCB_GET_PROPERTY_TYPE_ANY, 0, 256), nullptr));
    if (property && property->value_len > 0)
      return QString::fromUtf8(static_cast<const char*>(xcb_get_property_value(property.get())),
                               xcb_get_property_value_length(property.get()));
  }
  return {};
}

/// What people see: others are a desktop's and toolkits' own, as large as a dot or nowhere.
bool isSeen(xcb_connection_t* x, xcb_window_t window) {
  constexpr int leastSide = 8;
  const auto attributes =
      owned(xcb_get_window_attributes_reply(x, xcb_get_window_attributes(x, window), nullptr));
  const auto place = owned(xcb_get_geometry_reply(x, xcb_get_geometry(x, window), nullptr));
  return attributes && place && attributes->map_state == XCB_MAP_STATE_VIEWABLE &&
         place->width >= leastSide && place->height >= leastSide;
}

bool isOfThisProgram(xcb_connection_t* x, xcb_window_t window, xcb_atom_t netProcess) {
  const auto property = owned(xcb_get_property_reply(
      x, xcb_get_property(x, 0, window, netProcess, XCB_ATOM_CARDINAL, 0, 1), nullptr));
  return property && property->value_len == 1 &&
         *static_cast<const std::uint32_t*>(xcb_get_property_value(property.get())) ==
             static_cast<std::uint32_t>(QCoreApplication::applicationPid());
}

/// Names by which windows tell of themselves.
struct WindowAtoms {
  xcb_atom_t name, process;
};

std::vector<Window> titledWindows(xcb_connection_t* x, xcb_window_t under, const WindowAtoms& atoms) {
  std::vector<Window> found;
  auto tree = owned(xcb_query_tree_reply(x, xcb_query_tree(x, under), nullptr));
  if (!tree) return found;
  const xcb_window_t* children = xcb_query_tree_children(tree.get());
  for (int i = xcb_query_tree_children_length(tree.get()) - 1; i >= 0; --i) {
    if (QString title = titleOf(x, children[i], atoms.name); !title.isEmpty() && isSeen(x, children[i]))
      found.push_back({children[i], title, isOfThisProgram(x, children[i], atoms.process)});
    for (auto& inner : titledWindows(x, children[i], atoms)) found.push_back(std::move(inner));
  }
  return found;
}

/// A part of a window. Null if it cannot be had now.
QImage picked(xcb_connection_t* x, xcb_window_t window, const QRect& part) {
  auto image = owned(xcb_get_image_reply(
      x,
      xcb_get_image(x, XCB_IMAGE_FORMAT_Z_PIXMAP, window, static_cast<std::int16_t>(part.x()),
                    static_cast<std::int16_t>(part.y()), static_cast<std::uint16_t>(part.width()),
                    static_cast<std::uint16_t>(part.height()), ~0u),
      nullptr));
  if (!image || (image->depth != 24 && image->depth != 32)) return {};
  auto bytes = static_cast<qsizetype>(xcb_get_image_data_length(image.get()));
  if (bytes < qsizetype{4} * part.width() * part.height()) return {};
  return QImage(xcb_get_image_data(image.get()), part.width(), part.height(), 4 * part.width(),
                QImage::Format_RGB32)
      .convertToFormat(QImage::Format_RGBX8888);
}

}  // namespace

struct ScreenCapture::Server {
  std::unique_ptr<xcb_connection_t, decltype(&xcb_disconnect)> connection{xcb_connect(nullptr, nullptr),
                                                                          &xcb_disconnect};
  xcb_connection_t* x = connection.get();
  xcb_window_t root = XCB_NONE;

  Server() {
    if (xcb_connection_has_error(x) == 0) root = xcb_setup_roots_iterator(xcb_get_setup(x)).data->root;
  }
};

ScreenCapture::ScreenCapture() : server_(std::make_unique<Server>()) {}

ScreenCapture::~ScreenCapture() = default;

bool ScreenCapture::isConnected() const {
  return server_->root != XCB_NONE;
}

std::vector<Screen> ScreenCapture::screens() const {
  return isConnected() ? screensOf(server_->x, server_->root) : std::vector<Screen>();
}

std::vector<Window> ScreenCapture::windows() const {
  if (!isConnected()) return {};
  return titledWindows(server_->x, server_->root,
                       {atomOf(server_->x, "_NET_WM_NAME"), atomOf(server_->x, "_NET_WM_PID")});
}

QImage ScreenCapture::ofScreen(const QString& name) const {
  for (const Screen& screen : screens())
    if (screen.name == name && !screen.place.isEmpty())
      return picked(server_->x, server_->root, screen.place);
  return {};
}

QImage ScreenCapture::ofWindow(quint32 number) const {
  if (!isConnected()) return {};
  auto geometry = owned(xcb_get_geometry_reply(server_->x, xcb_get_geometry(server_->x, number), nullptr));
  return geometry ? picked(server_->x, number, {0, 0, geometry->width, geometry->height}) : QImage();
}

}  // namespace relucent::gui
