// SPDX-License-Identifier: MIT
#include "relucent/rehearsal/loopback_server.h"

#include <gio/gio.h>

#include <array>
#include <atomic>
#include <list>
#include <thread>
#include <utility>

#include "relucent/base/error.h"

namespace relucent::rehearsal {
namespace {

[[noreturn]] void failPort(int port, GError* error) {
  const std::string why = error != nullptr ? error->message : "";
  g_clear_error(&error);
  throw Error(ErrorKind::device,
              RELUCENT_ENGLISH_MESSAGE("rehearsal.no-port", "port {} of this computer cannot be had ({})")
                  .with(as::label(port), why),
              RELUCENT_ENGLISH_MESSAGE("rehearsal.end-other-program",
                                       "end the program that has it, and start again"));
}

class SocketVisitor : public Visitor {
 public:
  SocketVisitor(GSocket* socket, GCancellable* cancel) : socket_(socket), cancel_(cancel) {}

  bool receive(std::string& bytes) override {
    std::array<char, 1024> read{};
    const gssize count = g_socket_receive(socket_, read.data(), read.size(), cancel_, nullptr);
    if (count > 0) bytes.append(read.data(), static_cast<std::size_t>(count));
    return count > 0;
  }
  bool send(std::string_view bytes) override {
    while (!bytes.empty()) {
      const gssize count = g_socket_send(socket_, bytes.data(), bytes.size(), cancel_, nullptr);
      if (count <= 0) return false;
      bytes.remove_prefix(static_cast<std::size_t>(count));
    }
    return true;
  }
  bool pause(std::chrono::milliseconds time) override {
    using std::chrono::steady_clock;
    const steady_clock::time_point end = steady_clock::now() + time;
    for (;;) {
      const auto left = std::chrono::duration_cast<std::chrono::microseconds>(end - steady_clock::now());
      if (left.count() <= 0) return g_cancellable_is_cancelled(cancel_) == 0;
      if (g_socket_condition_timed_wait(socket_, G_IO_IN, left.count(), cancel_, nullptr) == 0) continue;
      std::string unasked;  // whoever goes is read as nothing
      if (!receive(unasked)) return false;
    }
  }

 private:
  GSocket* socket_;
  GCancellable* cancel_;
};

}  // namespace

class LoopbackServer::Impl {
  struct Unref {
    void operator()(gpointer object) const { g_object_unref(object); }
  };
  template <typename Object>
  using Owned = std::unique_ptr<Object, Unref>;

 public:
  Impl(int port, Serve serve) : serve_(std::move(serve)), cancel_(g_cancellable_new()) {
    GError* error = nullptr;
    listener_.reset(g_socket_new(G_SOCKET_FAMILY_IPV4, G_SOCKET_TYPE_STREAM, G_SOCKET_PROTOCOL_TCP, &error));
    if (!listener_) failPort(port, error);
    const Owned<GInetAddress> here(g_inet_address_new_loopback(G_SOCKET_FAMILY_IPV4));
    const Owned<GSocketAddress> place(g_inet_socket_address_new(here.get(), static_cast<guint16>(port)));
    if (g_socket_bind(listener_.get(), place.get(), TRUE, &error) == 0 ||
        g_socket_listen(listener_.get(), &error) == 0)
      failPort(port, error);
    const Owned<GSocketAddress> own(g_socket_get_local_address(listener_.get(), &error));
    if (!own) failPort(port, error);
    port_ = g_inet_socket_address_get_port(G_INET_SOCKET_ADDRESS(own.get()));
    accepting_ = std::thread([this] { accept(); });
  }
  ~Impl() {
    g_cancellable_cancel(cancel_.get());
    accepting_.join();
    for (Served& one : visitors_) one.thread.join();
  }
  int port() const { return port_; }

 private:
  struct Served {
    Owned<GSocket> socket;
    std::atomic<bool> isDone = false;
    std::thread thread{};
  };

  void accept() {
    while (g_cancellable_is_cancelled(cancel_.get()) == 0) {
      Owned<GSocket> socket(g_socket_accept(listener_.get(), cancel_.get(), nullptr));
      visitors_.remove_if([](Served& one) {
        if (one.isDone) one.thread.join();
        return one.isDone.load();
      });
      if (!socket) continue;
      Served& one = visitors_.emplace_back();
      one.socket = std::move(socket);
      one.thread = std::thread([this, &one] {
        SocketVisitor visitor(one.socket.get(), cancel_.get());
        serve_(visitor);
        g_socket_close(one.socket.get(), nullptr);
        one.isDone = true;
      });
    }
  }

  Serve serve_;
  Owned<GCancellable> cancel_;
  Owned<GSocket> listener_;
  int port_ = 0;
  std::list<Served> visitors_;  // of the accepting thread, until that has ended
  std::thread accepting_;
};

LoopbackServer::LoopbackServer(int port, Serve serve)
    : impl_(std::make_unique<Impl>(port, std::move(serve))) {}
LoopbackServer::~LoopbackServer() = default;

int LoopbackServer::port() const {
  return impl_->port();
}

}  // namespace relucent::rehearsal
