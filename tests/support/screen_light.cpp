// SPDX-License-Identifier: MIT
#include "support/screen_light.h"

#include <xcb/randr.h>
#include <xcb/xcb.h>

#include <cstdlib>
#include <optional>

namespace relucent::test {
namespace {

struct Free {
  void operator()(void* reply) const { std::free(reply); }
};
template <typename Reply>
std::unique_ptr<Reply, Free> owned(Reply* reply) {
  return std::unique_ptr<Reply, Free>(reply);
}

struct Place {
  int x = 0, y = 0;
  Size size;
};

}  // namespace

struct ScreenLight::Parts {
  std::string connector;
  xcb_connection_t* x = nullptr;
  xcb_window_t root = XCB_NONE;

  std::optional<Place> place() const {
    auto resources = owned(xcb_randr_get_screen_resources_current_reply(
        x, xcb_randr_get_screen_resources_current(x, root), nullptr));
    if (!resources) return std::nullopt;
    const xcb_randr_output_t* outputs = xcb_randr_get_screen_resources_current_outputs(resources.get());
    for (int i = 0; i < resources->num_outputs; ++i) {
      auto info = owned(xcb_randr_get_output_info_reply(
          x, xcb_randr_get_output_info(x, outputs[i], resources->config_timestamp), nullptr));
      if (!info || info->crtc == XCB_NONE) continue;
      const auto length = static_cast<std::size_t>(xcb_randr_get_output_info_name_length(info.get()));
      if (connector !=
          std::string(reinterpret_cast<const char*>(xcb_randr_get_output_info_name(info.get())), length))
        continue;
      auto crtc = owned(xcb_randr_get_crtc_info_reply(
          x, xcb_randr_get_crtc_info(x, info->crtc, resources->config_timestamp), nullptr));
      if (crtc && crtc->width > 0) return Place{crtc->x, crtc->y, {crtc->width, crtc->height}};
    }
    return std::nullopt;
  }
};

ScreenLight::ScreenLight(std::string connector) : parts_(std::make_unique<Parts>()) {
  parts_->connector = std::move(connector);
  parts_->x = xcb_connect(nullptr, nullptr);
  if (xcb_connection_has_error(parts_->x) == 0)
    parts_->root = xcb_setup_roots_iterator(xcb_get_setup(parts_->x)).data->root;
}

ScreenLight::~ScreenLight() {
  xcb_disconnect(parts_->x);
}

image::Image ScreenLight::look(Size size) const {
  image::Image light(size, 3, 0.0f);
  const std::optional<Place> place = parts_->place();
  if (!place || place->size.width < size.width || place->size.height < size.height) return light;
  auto image = owned(xcb_get_image_reply(
      parts_->x,
      xcb_get_image(parts_->x, XCB_IMAGE_FORMAT_Z_PIXMAP, parts_->root,
                    static_cast<std::int16_t>(place->x + (place->size.width - size.width) / 2),
                    static_cast<std::int16_t>(place->y + (place->size.height - size.height) / 2),
                    static_cast<std::uint16_t>(size.width), static_cast<std::uint16_t>(size.height), ~0u),
      nullptr));
  if (!image || xcb_get_image_data_length(image.get()) < 4 * size.width * size.height) return light;
  const std::uint8_t* bytes = xcb_get_image_data(image.get());
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x, bytes += 4)  // blue, green, red, nothing
      for (int c = 0; c < 3; ++c) light.at(x, y, c) = static_cast<float>(bytes[2 - c]) / 255.0f;
  return light;
}

}  // namespace relucent::test
