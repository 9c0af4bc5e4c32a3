// SPDX-License-Identifier: MIT
#include "support/gnome_monitors.h"

#include <gio/gio.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <stdexcept>

namespace relucent::tests {
namespace {

constexpr int patience = 20'000;  // milliseconds

struct Unref {
  void operator()(GVariant* value) const { g_variant_unref(value); }
  void operator()(GDBusConnection* bus) const { g_object_unref(bus); }
  void operator()(GVariantIter* iterator) const { g_variant_iter_free(iterator); }
};
template <typename Object>
using Owned = std::unique_ptr<Object, Unref>;

[[noreturn]] void fail(GError* error) {
  const std::string why = error != nullptr ? error->message : "no reason was given";
  g_clear_error(&error);
  throw std::runtime_error(why);
}

/// `service`: "ScreenCast", the name and the object; `interface`: behind it.
Owned<GVariant> call(GDBusConnection* bus, const std::string& service, const std::string& path,
                     const std::string& interface, const char* method, GVariant* arguments) {
  GError* error = nullptr;
  Owned<GVariant> answer(g_dbus_connection_call_sync(
      bus, ("org.gnome.Mutter." + service).c_str(), path.c_str(), ("org.gnome.Mutter." + interface).c_str(),
      method, arguments, nullptr, G_DBUS_CALL_FLAGS_NONE, patience, nullptr, &error));
  if (!answer) fail(error);
  return answer;
}

std::string objectIn(GVariant* answer) {
  const char* path = nullptr;
  g_variant_get(answer, "(&o)", &path);
  return path;
}

/// A monitor as GetCurrentState() has it.
struct Monitor {
  std::string connector, mode;
  int width = 0;
  double scale = 1.0, nearest = 1.0;  // of its mode's scales the one that is wanted
};

Monitor monitorFrom(GVariant* description, double wanted) {
  Monitor monitor;
  const char* connector = nullptr;
  GVariantIter* read = nullptr;
  g_variant_get(description, "((&s&s&s&s)a(siiddada{sv})a{sv})", &connector, nullptr, nullptr, nullptr, &read,
                nullptr);
  monitor.connector = connector;
  const Owned<GVariantIter> modes(read);
  const char* id = nullptr;
  int width = 0;
  GVariantIter* scales = nullptr;
  GVariant* properties = nullptr;
  while (g_variant_iter_next(modes.get(), "(&siidd@ad@a{sv})", &id, &width, nullptr, nullptr, nullptr,
                             &properties, nullptr) != 0) {
    // Headless monitors have one mode.
    monitor.mode = id;
    monitor.width = width;
    double best = std::numeric_limits<double>::infinity(), one = 0.0;
    g_variant_get(properties, "ad", &scales);
    const Owned<GVariantIter> list(scales);
    while (g_variant_iter_next(list.get(), "d", &one) != 0)
      if (std::abs(one - wanted) < best) {
        best = std::abs(one - wanted);
        monitor.nearest = one;
      }
    g_variant_unref(properties);
  }
  return monitor;
}

}  // namespace

struct GnomeMonitors::Bus {
  Owned<GDBusConnection> connection;
};

GnomeMonitors::GnomeMonitors() : bus_(std::make_unique<Bus>()) {
  GError* error = nullptr;
  bus_->connection.reset(g_bus_get_sync(G_BUS_TYPE_SESSION, nullptr, &error));
  if (!bus_->connection) fail(error);
}
GnomeMonitors::~GnomeMonitors() = default;

double GnomeMonitors::scale(const std::string& connector, double scale) {
  const std::string path = "/org/gnome/Mutter/DisplayConfig";
  const Owned<GVariant> state =
      call(bus_->connection.get(), "DisplayConfig", path, "DisplayConfig", "GetCurrentState", nullptr);
  guint32 serial = 0;
  g_variant_get_child(state.get(), 0, "u", &serial);
  const Owned<GVariant> monitors(g_variant_get_child_value(state.get(), 1));
  GVariantBuilder logical;
  g_variant_builder_init(&logical, G_VARIANT_TYPE("a(iiduba(ssa{sv}))"));
  int x = 0;
  double taken = 0.0;
  for (gsize i = 0; i < g_variant_n_children(monitors.get()); ++i) {
    const Owned<GVariant> description(g_variant_get_child_value(monitors.get(), i));
    const Monitor monitor = monitorFrom(description.get(), scale);
    const bool isWanted = monitor.connector == connector;
    const double its = isWanted ? monitor.nearest : 1.0;
    if (isWanted) taken = its;
    GVariantBuilder within;
    g_variant_builder_init(&within, G_VARIANT_TYPE("a(ssa{sv})"));
    g_variant_builder_add(&within, "(ssa{sv})", monitor.connector.c_str(), monitor.mode.c_str(), nullptr);
    g_variant_builder_add(&logical, "(iiduba(ssa{sv}))", x, 0, its, 0U, static_cast<gboolean>(i == 0),
                          &within);
    x += static_cast<int>(std::lround(monitor.width / its));
  }
  constexpr guint32 temporarily = 1;
  call(bus_->connection.get(), "DisplayConfig", path, "DisplayConfig", "ApplyMonitorsConfig",
       g_variant_new("(uua(iiduba(ssa{sv}))a{sv})", serial, temporarily, &logical, nullptr));
  return taken;
}

struct GnomeMonitors::Recording::Session {
  Owned<GDBusConnection> connection;
  std::string path;
  std::uint32_t node = 0;
};

GnomeMonitors::Recording::Recording(std::unique_ptr<Session> session) : session_(std::move(session)) {}
GnomeMonitors::Recording::Recording(Recording&&) noexcept = default;
GnomeMonitors::Recording::~Recording() {
  if (!session_) return;
  try {
    call(session_->connection.get(), "ScreenCast", session_->path, "ScreenCast.Session", "Stop", nullptr);
  } catch (const std::runtime_error&) {  // it ends with the session bus at the latest
  }
}
std::uint32_t GnomeMonitors::Recording::node() const {
  return session_->node;
}

GnomeMonitors::Recording GnomeMonitors::record(const std::string& connector) {
  auto session = std::make_unique<Recording::Session>();
  session->connection.reset(static_cast<GDBusConnection*>(g_object_ref(bus_->connection.get())));
  GDBusConnection* bus = session->connection.get();
  session->path = objectIn(call(bus, "ScreenCast", "/org/gnome/Mutter/ScreenCast", "ScreenCast",
                                "CreateSession", g_variant_new("(a{sv})", nullptr))
                               .get());
  const std::string stream =
      objectIn(call(bus, "ScreenCast", session->path, "ScreenCast.Session", "RecordMonitor",
                    g_variant_new("(sa{sv})", connector.c_str(), nullptr))
                   .get());
  // Signals arrive where they were asked for: in a loop of this call's own.
  GMainContext* loop = g_main_context_new();
  g_main_context_push_thread_default(loop);
  const auto added = [](GDBusConnection*, const char*, const char*, const char*, const char*,
                        GVariant* arguments, gpointer node) {
    g_variant_get(arguments, "(u)", static_cast<std::uint32_t*>(node));
  };
  const guint listening = g_dbus_connection_signal_subscribe(
      bus, nullptr, "org.gnome.Mutter.ScreenCast.Stream", "PipeWireStreamAdded", stream.c_str(), nullptr,
      G_DBUS_SIGNAL_FLAGS_NONE, added, &session->node, nullptr);
  std::string failure;
  try {
    call(bus, "ScreenCast", session->path, "ScreenCast.Session", "Start", nullptr);
    const gint64 end = g_get_monotonic_time() + gint64{patience} * 1000;
    while (session->node == 0 && g_get_monotonic_time() < end)
      if (g_main_context_iteration(loop, FALSE) == 0) g_usleep(1000);
    if (session->node == 0) failure = "the compositor records nothing";
  } catch (const std::runtime_error& error) {
    failure = error.what();
  }
  g_dbus_connection_signal_unsubscribe(bus, listening);
  g_main_context_pop_thread_default(loop);
  g_main_context_unref(loop);
  if (!failure.empty()) throw std::runtime_error(failure);
  return Recording(std::move(session));
}

int connectedToPipeWire() {
  const char* folder = std::getenv("XDG_RUNTIME_DIR");
  sockaddr_un place{};
  place.sun_family = AF_UNIX;
  const std::string path = std::string(folder != nullptr ? folder : "") + "/pipewire-0";
  if (path.size() >= sizeof(place.sun_path)) throw std::runtime_error("the path to PipeWire is too long");
  std::memcpy(place.sun_path, path.c_str(), path.size() + 1);
  const int connection = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  if (connection < 0 || connect(connection, reinterpret_cast<sockaddr*>(&place), sizeof(place)) != 0) {
    if (connection >= 0) close(connection);
    throw std::runtime_error("PipeWire cannot be reached");
  }
  return connection;
}

}  // namespace relucent::tests
