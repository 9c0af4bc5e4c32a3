// SPDX-License-Identifier: MIT
#include "content/live_screen.h"

#include <xcb/randr.h>
#include <xcb/xcb.h>

#include <QRect>
#include <QStringList>
#include <optional>
#include <utility>
#include <vector>

#include "base/error.h"
#include "content/still_image.h"
#include "content/xcb_answer.h"

namespace relucent {
namespace {

using Connection = std::unique_ptr<xcb_connection_t, decltype(&xcb_disconnect)>;

Connection connected() {
  Connection connection(xcb_connect(nullptr, nullptr), &xcb_disconnect);
  if (xcb_connection_has_error(connection.get()) != 0)
    throw Error(ErrorKind::device, "the live picture of a screen needs an X server, and none answers",
                "log in to a desktop on X (\"Xorg\" at the log-in), or play files");
  return connection;
}

struct Output {
  QString name;
  QRect place;  // on the root window; empty while it is off
};

std::vector<Output> outputsOf(xcb_connection_t* x, xcb_window_t root) {
  auto resources = owned(xcb_randr_get_screen_resources_current_reply(
      x, xcb_randr_get_screen_resources_current(x, root), nullptr));
  std::vector<Output> found;
  if (!resources) return found;
  const xcb_randr_output_t* outputs = xcb_randr_get_screen_resources_current_outputs(resources.get());
  for (int i = 0; i < resources->num_outputs; ++i) {
    auto info = owned(xcb_randr_get_output_info_reply(
        x, xcb_randr_get_output_info(x, outputs[i], resources->config_timestamp), nullptr));
    if (!info) continue;
    Output output;
    output.name = QString::fromUtf8(reinterpret_cast<const char*>(xcb_randr_get_output_info_name(info.get())),
                                    xcb_randr_get_output_info_name_length(info.get()));
    if (info->crtc != XCB_NONE) {
      auto crtc = owned(xcb_randr_get_crtc_info_reply(
          x, xcb_randr_get_crtc_info(x, info->crtc, resources->config_timestamp), nullptr));
      if (crtc) output.place = {crtc->x, crtc->y, crtc->width, crtc->height};
    }
    found.push_back(output);
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

/// All windows with a title, the ones in front first.
std::vector<std::pair<xcb_window_t, QString>> titledWindows(xcb_connection_t* x, xcb_window_t under,
                                                            xcb_atom_t netName) {
  std::vector<std::pair<xcb_window_t, QString>> found;
  auto tree = owned(xcb_query_tree_reply(x, xcb_query_tree(x, under), nullptr));
  if (!tree) return found;
  const xcb_window_t* children = xcb_query_tree_children(tree.get());
  for (int i = xcb_query_tree_children_length(tree.get()) - 1; i >= 0; --i) {
    if (QString title = titleOf(x, children[i], netName); !title.isEmpty())
      found.emplace_back(children[i], title);
    for (auto& inner : titledWindows(x, children[i], netName)) found.push_back(std::move(inner));
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

/// One screen or window, found.
class LiveScreen::Grabber {
 public:
  Grabber(What what, QString which) : x_(connected()), which_(std::move(which)) {
    root_ = xcb_setup_roots_iterator(xcb_get_setup(x_.get())).data->root;
    what == What::screen ? findScreen() : findWindow();
  }

  QImage grab() {
    if (window_ != XCB_NONE) {
      auto geometry = owned(xcb_get_geometry_reply(x_.get(), xcb_get_geometry(x_.get(), window_), nullptr));
      return geometry ? picked(x_.get(), window_, {0, 0, geometry->width, geometry->height}) : QImage();
    }
    for (const Output& output : outputsOf(x_.get(), root_))
      if (output.name == which_ && !output.place.isEmpty()) return picked(x_.get(), root_, output.place);
    return {};
  }

 private:
  void findScreen() {
    QStringList names;
    for (const Output& output : outputsOf(x_.get(), root_)) {
      if (output.name == which_) return;
      if (!output.place.isEmpty()) names.append(output.name);
    }
    throw Error(ErrorKind::input, fmt::format("there is no screen '{}'", which_.toStdString()),
                fmt::format("choose one of {}", names.join(", ").toStdString()));
  }

  void findWindow() {
    xcb_atom_t netName = atomOf(x_.get(), "_NET_WM_NAME");
    bool isNumber = false;
    auto number = static_cast<xcb_window_t>(which_.toUInt(&isNumber, 0));
    QStringList titles;
    for (const auto& [window, title] : titledWindows(x_.get(), root_, netName)) {
      if (isNumber ? window == number : title.contains(which_, Qt::CaseInsensitive)) {
        window_ = window;
        return;
      }
      titles.append(title);
    }
    throw Error(ErrorKind::input, fmt::format("there is no window '{}'", which_.toStdString()),
                titles.isEmpty()
                    ? "open it first"
                    : fmt::format("open it first; there are: {}", titles.join(", ").toStdString()));
  }

  Connection x_;
  QString which_;
  xcb_window_t root_ = XCB_NONE, window_ = XCB_NONE;
};

LiveScreen::LiveScreen(What what, const QString& which, const Canvas& canvas)
    : grabber_(std::make_unique<Grabber>(what, which)), canvas_(canvas) {}

LiveScreen::~LiveScreen() = default;

ContentPicture LiveScreen::at(ContentTime) {
  QImage now = grabber_->grab();
  // What has not changed need not be computed again.
  if (!now.isNull() && now != grabbed_) {
    grabbed_ = std::move(now);
    picture_ = {onCanvas(grabbed_, canvas_), nextFrameNumber()};
  }
  if (picture_.image.isNull()) {
    QImage black(canvas_.size, QImage::Format_RGBX8888);
    black.fill(Qt::black);
    picture_ = {black, nextFrameNumber()};
  }
  return picture_;
}

}  // namespace relucent
