// SPDX-License-Identifier: MIT
#include "relucent/pjlink/search.h"

#include <algorithm>
#include <array>
#include <map>

#include "relucent/base/error.h"
#include "relucent/pjlink/gio.h"
#include "relucent/pjlink/protocol.h"
#include "relucent/platform/broadcast_addresses.h"

namespace relucent::pjlink {
namespace {

constexpr std::string_view question = "%2SRCH\r";

[[noreturn]] void failNetwork(const std::string& why) {
  throw Error(ErrorKind::device,
              RELUCENT_MESSAGE("pjlink.cannot-search", "projectors cannot be searched ({})").with(why),
              RELUCENT_MESSAGE("pjlink.check-own-network",
                               "check this computer's network, or give the projector's address"));
}

/// Projectors answer to where the question came from; some to the standard port, whatever that was.
Owned<GSocket> boundSocket() {
  Failure failure;
  Owned<GSocket> socket(
      g_socket_new(G_SOCKET_FAMILY_IPV4, G_SOCKET_TYPE_DATAGRAM, G_SOCKET_PROTOCOL_UDP, failure.fresh()));
  if (!socket) failNetwork(failure.text());
  g_socket_set_blocking(socket.get(), FALSE);
  g_socket_set_broadcast(socket.get(), TRUE);
  const Owned<GInetAddress> any(g_inet_address_new_any(G_SOCKET_FAMILY_IPV4));
  for (int port : {standardPort, 0}) {
    const Owned<GSocketAddress> place(g_inet_socket_address_new(any.get(), static_cast<guint16>(port)));
    if (g_socket_bind(socket.get(), place.get(), FALSE, failure.fresh()) != 0) return socket;
  }
  failNetwork(failure.text());
}

/// Why nobody could be asked; empty: somebody was.
std::string ask(GSocket* socket, const std::vector<std::string>& targets, int port) {
  std::string why = "there is no network";
  bool asked = false;
  for (const std::string& target : targets) {
    Failure failure;
    const Owned<GSocketAddress> place(
        g_inet_socket_address_new_from_string(target.c_str(), static_cast<guint16>(port)));
    const gssize sent =
        g_socket_send_to(socket, place.get(), question.data(), question.size(), nullptr, failure.fresh());
    if (sent > 0)
      asked = true;
    else
      why = failure.text();
  }
  return asked ? "" : why;
}

std::string hostOf(GSocketAddress* from) {
  GInetAddress* number = g_inet_socket_address_get_address(G_INET_SOCKET_ADDRESS(from));
  const std::unique_ptr<char, decltype(&g_free)> text(g_inet_address_to_string(number), &g_free);
  return text.get();
}

bool isNumber(const std::string& target) {
  const Owned<GInetAddress> number(g_inet_address_new_from_string(target.c_str()));
  return number && g_inet_address_get_family(number.get()) == G_SOCKET_FAMILY_IPV4;
}

}  // namespace

std::vector<Message> problems(const SearchSettings& settings) {
  std::vector<Message> found;
  for (const std::string& target : settings.targets)
    if (!isNumber(target))
      found.push_back(
          RELUCENT_ENGLISH_MESSAGE("pjlink.target-no-number",
                                   "'{}' is no address in which to search: write a number, as 192.168.1.255")
              .with(target));
  return found;
}

std::vector<Found> searchProjectors(const SearchSettings& settings, Progress& progress) {
  const std::vector<std::string> targets =
      settings.targets.empty() ? platform::broadcastAddresses() : settings.targets;
  const Owned<GSocket> socket = boundSocket();
  std::map<std::string, Found> found;
  for (int round = 0; round < 2; ++round) {
    if (const std::string why = ask(socket.get(), targets, settings.port); !why.empty()) failNetwork(why);
    const Deadline deadline = std::chrono::steady_clock::now() + settings.patience / 2;
    // Whoever floods this port takes no more than the time that there is.
    while (std::chrono::steady_clock::now() < deadline &&
           waitFor(socket.get(), G_IO_IN, deadline, progress)) {
      Failure failure;
      std::array<char, 128> bytes{};
      GSocketAddress* from = nullptr;
      const gssize count =
          g_socket_receive_from(socket.get(), &from, bytes.data(), bytes.size(), nullptr, failure.fresh());
      const Owned<GSocketAddress> sender(from);
      if (count <= 0 || !sender) continue;
      const auto hardware = foundFrom({bytes.data(), static_cast<std::size_t>(count)});
      const std::string host = hostOf(sender.get());
      if (hardware && found.size() < mostFound) found.try_emplace(host, Found{{host}, *hardware});
    }
    progress.report(0.5 * (round + 1));
  }
  std::vector<Found> list;
  for (auto& [host, one] : found) list.push_back(std::move(one));
  return list;
}

}  // namespace relucent::pjlink
