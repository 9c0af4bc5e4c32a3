// SPDX-License-Identifier: MIT
#include "desktop/wayland_compositor.h"

#include <qpa/qplatformnativeinterface.h>
#include <wayland-client.h>

#include <QGuiApplication>
#include <QLibraryInfo>
#include <QScreen>
#include <QVersionNumber>
#include <algorithm>
#include <string_view>
#include <vector>

#include "protocols/idle-inhibit-unstable-v1.h"
#include "protocols/viewporter.h"
#include "protocols/xdg-output-unstable-v1.h"

namespace relucent::gui {
namespace wayland {

struct Output {
  std::uint32_t global = 0;
  wl_output* output = nullptr;
  zxdg_output_v1* described = nullptr;
  QString name;
  QSize mode;
  bool isOnItsSide = false;
};

}  // namespace wayland
namespace {

using wayland::Output;

/// Versions of the protocols from which on outputs have names.
constexpr std::uint32_t namedOutput = 4, namedXdgOutput = 2;

void isNamed(void* data, wl_output*, const char* name) {
  static_cast<Output*>(data)->name = QString::fromUtf8(name);
}
void stands(void* data, wl_output*, std::int32_t, std::int32_t, std::int32_t, std::int32_t, std::int32_t,
            const char*, const char*, std::int32_t transform) {
  static_cast<Output*>(data)->isOnItsSide =
      transform == WL_OUTPUT_TRANSFORM_90 || transform == WL_OUTPUT_TRANSFORM_270 ||
      transform == WL_OUTPUT_TRANSFORM_FLIPPED_90 || transform == WL_OUTPUT_TRANSFORM_FLIPPED_270;
}
void hasMode(void* data, wl_output*, std::uint32_t flags, std::int32_t width, std::int32_t height,
             std::int32_t) {
  if ((flags & WL_OUTPUT_MODE_CURRENT) != 0) static_cast<Output*>(data)->mode = {width, height};
}

constexpr wl_output_listener outputListener{
    .geometry = stands,
    .mode = hasMode,
    .done = [](void*, wl_output*) {},
    .scale = [](void*, wl_output*, std::int32_t) {},
    .name = isNamed,
    .description = [](void*, wl_output*, const char*) {},
};
constexpr zxdg_output_v1_listener xdgListener{
    .logical_position = [](void*, zxdg_output_v1*, std::int32_t, std::int32_t) {},
    .logical_size = [](void*, zxdg_output_v1*, std::int32_t, std::int32_t) {},
    .done = [](void*, zxdg_output_v1*) {},
    .name = [](void* data, zxdg_output_v1*, const char* name) { isNamed(data, nullptr, name); },
    .description = [](void*, zxdg_output_v1*, const char*) {},
};

/// Qt lays out surfaces of its own by viewports from 6.5 on, where the compositor scales by fractions.
bool usesViewports(bool fractionalScale) {
  return fractionalScale && QLibraryInfo::version() >= QVersionNumber(6, 5);
}

}  // namespace

struct WaylandCompositor::Connection {
  wl_display* display = nullptr;
  wl_event_queue* queue = nullptr;
  wl_registry* registry = nullptr;
  wp_viewporter* viewporter = nullptr;
  zwp_idle_inhibit_manager_v1* idleInhibitor = nullptr;
  zxdg_output_manager_v1* describing = nullptr;
  bool scalesByFractions = false;
  std::vector<std::unique_ptr<Output>> outputs;

  template <typename Interface>
  Interface* bind(std::uint32_t global, const wl_interface& interface, std::uint32_t version) {
    return static_cast<Interface*>(wl_registry_bind(registry, global, &interface, version));
  }
  void appeared(std::uint32_t global, std::string_view name, std::uint32_t version) {
    if (name == wl_output_interface.name) {
      Output& output = *outputs.emplace_back(std::make_unique<Output>());
      output.global = global;
      output.output = bind<wl_output>(global, wl_output_interface, std::min(version, namedOutput));
      wl_output_add_listener(output.output, &outputListener, &output);
      if (version < namedOutput) describe(output);
    } else if (name == wp_viewporter_interface.name) {
      viewporter = bind<wp_viewporter>(global, wp_viewporter_interface, 1);
    } else if (name == zwp_idle_inhibit_manager_v1_interface.name) {
      idleInhibitor = bind<zwp_idle_inhibit_manager_v1>(global, zwp_idle_inhibit_manager_v1_interface, 1);
    } else if (name == zxdg_output_manager_v1_interface.name && version >= namedXdgOutput) {
      describing = bind<zxdg_output_manager_v1>(global, zxdg_output_manager_v1_interface, namedXdgOutput);
      for (const auto& output : outputs) describe(*output);
    } else if (name == "wp_fractional_scale_manager_v1") {
      scalesByFractions = true;
    }
  }
  void describe(Output& output) {
    if (describing == nullptr || output.described != nullptr ||
        wl_output_get_version(output.output) >= namedOutput)
      return;
    output.described = zxdg_output_manager_v1_get_xdg_output(describing, output.output);
    zxdg_output_v1_add_listener(output.described, &xdgListener, &output);
  }
  void vanished(std::uint32_t global) {
    std::erase_if(outputs, [global](const auto& output) {
      if (output->global != global) return false;
      if (output->described != nullptr) zxdg_output_v1_destroy(output->described);
      wl_output_destroy(output->output);
      return true;
    });
  }
  const Output* find(const QString& name) const {
    auto found = std::find_if(outputs.begin(), outputs.end(),
                              [&](const auto& output) { return output->name == name; });
    return found != outputs.end() ? found->get() : nullptr;
  }
};

WaylandCompositor* WaylandCompositor::instance() {
  static WaylandCompositor* const only = []() -> WaylandCompositor* {
    if (!QGuiApplication::platformName().startsWith("wayland")) return nullptr;
    void* display = QGuiApplication::platformNativeInterface()->nativeResourceForIntegration("wl_display");
    return display != nullptr ? new WaylandCompositor(static_cast<wl_display*>(display)) : nullptr;
  }();
  return only;
}

WaylandCompositor::WaylandCompositor(wl_display* display) : connection_(std::make_unique<Connection>()) {
  static constexpr wl_registry_listener listener{
      .global =
          [](void* data, wl_registry*, std::uint32_t global, const char* name, std::uint32_t version) {
            static_cast<Connection*>(data)->appeared(global, name, version);
          },
      .global_remove = [](void* data, wl_registry*,
                          std::uint32_t global) { static_cast<Connection*>(data)->vanished(global); },
  };
  connection_->display = display;
  connection_->queue = wl_display_create_queue(display);
  // What is made of the wrapper tells its events to our queue.
  auto* wrapper = static_cast<wl_display*>(wl_proxy_create_wrapper(display));
  wl_proxy_set_queue(reinterpret_cast<wl_proxy*>(wrapper), connection_->queue);
  connection_->registry = wl_display_get_registry(wrapper);
  wl_proxy_wrapper_destroy(wrapper);
  wl_registry_add_listener(connection_->registry, &listener, connection_.get());
  // What there is, and then what that has to tell.
  for (int trip = 0; trip < 2; ++trip) wl_display_roundtrip_queue(display, connection_->queue);
}

QSize WaylandCompositor::pixelsOf(const QScreen& screen) {
  wl_display_dispatch_queue_pending(connection_->display, connection_->queue);
  const Output* output = connection_->find(screen.name());
  if (output == nullptr) return {};
  return output->isOnItsSide ? output->mode.transposed() : output->mode;
}

wp_viewporter* WaylandCompositor::viewporter() const {
  return usesViewports(connection_->scalesByFractions) ? nullptr : connection_->viewporter;
}

zwp_idle_inhibit_manager_v1* WaylandCompositor::idleInhibitor() const {
  return connection_->idleInhibitor;
}

}  // namespace relucent::gui
