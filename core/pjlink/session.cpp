// SPDX-License-Identifier: MIT
#include "relucent/pjlink/session.h"

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "relucent/base/error.h"
#include "relucent/pjlink/gio.h"

namespace relucent::pjlink {
namespace {

constexpr int mostOtherLines = 4;  // late answers to earlier commands, before the one that was asked for

[[noreturn]] void failSilent(const Address& address, const Message& why) {
  throw Error(
      ErrorKind::device,
      RELUCENT_MESSAGE("pjlink.no-answer", "the projector at {} does not answer ({})")
          .with(toString(address), why),
      RELUCENT_MESSAGE("pjlink.check-network",
                       "check its address, its network cable, and that PJLink and the network in standby are "
                       "switched on in its menu"));
}

[[noreturn]] void failPassword(const Address& address) {
  throw Error(ErrorKind::device,
              address.password.empty()
                  ? RELUCENT_MESSAGE("pjlink.wants-password", "the projector at {} asks for a password")
                        .with(toString(address))
                  : RELUCENT_MESSAGE("pjlink.wrong-password", "the projector at {} refuses the password")
                        .with(toString(address)),
              RELUCENT_MESSAGE("pjlink.give-password", "give the PJLink password that is set in its menu"));
}

[[noreturn]] void failForeign(const Address& address) {
  throw Error(
      ErrorKind::device,
      RELUCENT_MESSAGE("pjlink.not-pjlink", "what answers at {} does not speak PJLink")
          .with(toString(address)),
      RELUCENT_MESSAGE("pjlink.check-address-and-port", "check the address and the port of the projector"));
}

Message tooSlow() {
  return RELUCENT_MESSAGE("pjlink.too-slow", "nothing complete came in time");
}

/// A name looked up on GIO's threads: a name server that is gone must not hold anybody up.
class Lookup {
 public:
  explicit Lookup(const std::string& host) : context_(g_main_context_new()), cancel_(g_cancellable_new()) {
    g_main_context_push_thread_default(context_);
    const Owned<GResolver> resolver(g_resolver_get_default());
    g_resolver_lookup_by_name_async(resolver.get(), host.c_str(), cancel_.get(), &Lookup::finish, this);
  }
  ~Lookup() {
    // The answer is for this object, so that it has to come before this ends; a cancelled one comes at once.
    if (!done_) g_cancellable_cancel(cancel_.get());
    while (!done_) g_main_context_iteration(context_, TRUE);
    g_resolver_free_addresses(addresses_);
    g_main_context_pop_thread_default(context_);
    g_main_context_unref(context_);
  }
  Lookup(const Lookup&) = delete;
  Lookup& operator=(const Lookup&) = delete;

  /// Owned by this. Throws: Cancelled.
  std::vector<GInetAddress*> addresses(Deadline deadline, const Progress& progress) {
    GSource* tick = g_timeout_source_new(static_cast<guint>(betweenLooks.count()));
    g_source_set_callback(tick, [](gpointer) -> gboolean { return G_SOURCE_CONTINUE; }, nullptr, nullptr);
    g_source_attach(tick, context_);
    const std::unique_ptr<GSource, void (*)(GSource*)> ticking(tick, [](GSource* source) {
      g_source_destroy(source);
      g_source_unref(source);
    });
    while (!done_ && std::chrono::steady_clock::now() < deadline) {
      progress.checkpoint();
      g_main_context_iteration(context_, TRUE);
    }
    std::vector<GInetAddress*> found;
    for (GList* one = addresses_; one != nullptr; one = one->next)
      found.push_back(static_cast<GInetAddress*>(one->data));
    return found;
  }
  std::string why() const { return failure_.text(); }

 private:
  static void finish(GObject* resolver, GAsyncResult* result, gpointer self) {
    auto& lookup = *static_cast<Lookup*>(self);
    lookup.addresses_ =
        g_resolver_lookup_by_name_finish(G_RESOLVER(resolver), result, lookup.failure_.fresh());
    lookup.done_ = true;
  }

  GMainContext* context_;
  Owned<GCancellable> cancel_;
  GList* addresses_ = nullptr;
  Failure failure_;
  bool done_ = false;
};

}  // namespace

/// Bytes as lines.
class Session::Line {
 public:
  Line(const Address& address, Deadline deadline, const Progress& progress) : address_(address) {
    Lookup lookup(address.host);
    const std::vector<GInetAddress*> places = lookup.addresses(deadline, progress);
    Message why = lookup.why().empty() ? tooSlow() : Message::plain(lookup.why());
    for (GInetAddress* place : places) {
      why = connect(place, deadline, progress);
      if (why.empty()) return;
    }
    failSilent(address_, why);
  }

  void send(const std::string& text, Deadline deadline, const Progress& progress) {
    Failure failure;
    for (std::size_t sent = 0; sent < text.size();) {
      const gssize more = g_socket_send_with_blocking(socket_.get(), text.data() + sent, text.size() - sent,
                                                      FALSE, nullptr, failure.fresh());
      if (more > 0) {
        sent += static_cast<std::size_t>(more);
      } else if (!failure.is(G_IO_ERROR_WOULD_BLOCK)) {
        failSilent(address_, Message::plain(failure.text()));
      } else if (!waitFor(socket_.get(), G_IO_OUT, deadline, progress)) {
        failSilent(address_, tooSlow());
      }
    }
  }

  /// Without the carriage return.
  std::string next(Deadline deadline, const Progress& progress) {
    for (;;) {
      if (const std::size_t end = received_.find('\r'); end != std::string::npos && end <= longestLine) {
        std::string line = received_.substr(0, end);
        received_.erase(0, end + 1);
        while (line.starts_with('\n')) line.erase(0, 1);  // of a line that ended in both
        return line;
      }
      if (received_.size() > longestLine) failForeign(address_);
      if (!waitFor(socket_.get(), G_IO_IN, deadline, progress)) failSilent(address_, tooSlow());
      receive();
    }
  }

 private:
  /// Why not; empty: it is connected.
  Message connect(GInetAddress* place, Deadline deadline, const Progress& progress) {
    Failure failure;
    socket_.reset(g_socket_new(g_inet_address_get_family(place), G_SOCKET_TYPE_STREAM, G_SOCKET_PROTOCOL_TCP,
                               failure.fresh()));
    if (!socket_) return Message::plain(failure.text());
    g_socket_set_blocking(socket_.get(), FALSE);
    const Owned<GSocketAddress> target(g_inet_socket_address_new(place, static_cast<guint16>(address_.port)));
    if (g_socket_connect(socket_.get(), target.get(), nullptr, failure.fresh()) != 0) return {};
    if (!failure.is(G_IO_ERROR_PENDING)) return Message::plain(failure.text());
    if (!waitFor(socket_.get(), G_IO_OUT, deadline, progress)) return tooSlow();
    if (g_socket_check_connect_result(socket_.get(), failure.fresh()) != 0) return {};
    return Message::plain(failure.text());
  }

  void receive() {
    Failure failure;
    std::array<char, longestLine> bytes{};
    const gssize count = g_socket_receive_with_blocking(socket_.get(), bytes.data(), bytes.size(), FALSE,
                                                        nullptr, failure.fresh());
    if (count > 0)
      received_.append(bytes.data(), static_cast<std::size_t>(count));
    else if (count == 0)
      failSilent(address_, RELUCENT_MESSAGE("pjlink.closed", "it closed the connection"));
    else if (!failure.is(G_IO_ERROR_WOULD_BLOCK))
      failSilent(address_, Message::plain(failure.text()));
  }

  const Address& address_;
  Owned<GSocket> socket_;
  std::string received_;
};

Session::Session(const Address& address, const Patience& patience, const Progress& progress)
    : address_(address), patience_(patience), progress_(progress) {
  const Deadline deadline = std::chrono::steady_clock::now() + patience.connecting;
  line_ = std::make_unique<Line>(address_, deadline, progress_);
  const std::optional<Greeting> greeting = greetingFrom(line_->next(deadline, progress_));
  if (!greeting) failForeign(address_);
  switch (greeting->kind) {
    case Greeting::Kind::open:
      return;
    case Greeting::Kind::password:
      if (address_.password.empty()) failPassword(address_);
      digest_ = digestOf(greeting->challenge, address_.password);
      return;
    case Greeting::Kind::newer:
      throw Error(ErrorKind::device,
                  RELUCENT_MESSAGE(
                      "pjlink.newer-authentication",
                      "the projector at {} asks for its password in a way that this version does not know")
                      .with(toString(address_)),
                  RELUCENT_MESSAGE("pjlink.choose-class-one-authentication",
                                   "choose the authentication of PJLink class 1 in its menu, or none"));
    case Greeting::Kind::refused:
      failPassword(address_);
  }
}

Session::~Session() = default;

std::optional<Answer> Session::ask(std::string_view command, std::string_view parameter, int protocolClass) {
  const Deadline deadline = std::chrono::steady_clock::now() + patience_.answering;
  line_->send(std::exchange(digest_, {}) + requestOf(protocolClass, command, parameter), deadline, progress_);
  for (int others = 0; others < mostOtherLines; ++others) {
    const std::string line = line_->next(deadline, progress_);
    if (isWrongPassword(line)) failPassword(address_);
    if (std::optional<Answer> answer = answerFrom(line, command)) return answer;
    // An answer to a command before comes late; what is none at all is taken for this one's.
    if (!isAnswer(line)) return std::nullopt;
  }
  return std::nullopt;
}

}  // namespace relucent::pjlink
