// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace relucent::pjlink {

inline constexpr int standardPort = 4352;

/// A projector on the network.
struct Address {
  std::string host;  // a name or a number; IPv6 without brackets
  int port = standardPort;
  std::string password{};  // empty: none; never written into logs, nor into anything that toString() makes

  bool operator==(const Address&) const = default;
};

/// "host", "host:port" or "[fe80::1]:port", without the password.
std::string toString(const Address& address);

/// The same read. None: it is no such address.
std::optional<Address> addressFrom(std::string_view text);

}  // namespace relucent::pjlink
