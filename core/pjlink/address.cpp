// SPDX-License-Identifier: MIT
#include "relucent/pjlink/address.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>

namespace relucent::pjlink {
namespace {

constexpr std::size_t longestHost = 253;  // of a name in the DNS

bool isName(std::string_view host) {
  return !host.empty() && host.size() <= longestHost && std::ranges::all_of(host, [](unsigned char letter) {
    return std::isalnum(letter) != 0 || letter == '.' || letter == '-' || letter == '_';
  });
}

bool isLongNumber(std::string_view host) {
  return host.size() >= 2 && host.size() <= longestHost &&
         std::ranges::all_of(host, [](unsigned char letter) {
           return std::isalnum(letter) != 0 || letter == ':' || letter == '.' || letter == '%';
         });
}

std::optional<int> portFrom(std::string_view text) {
  int port = 0;
  const char* end = text.data() + text.size();
  const auto [after, error] = std::from_chars(text.data(), end, port);
  if (error != std::errc() || after != end || port < 1 || port > 65535) return std::nullopt;
  return port;
}

}  // namespace

std::string toString(const Address& address) {
  const bool isLong = address.host.find(':') != std::string::npos;
  if (address.port == standardPort && !isLong) return address.host;
  return fmt::format("{}{}{}:{}", isLong ? "[" : "", address.host, isLong ? "]" : "", address.port);
}

std::optional<Address> addressFrom(std::string_view text) {
  std::string_view host = text, port;
  bool isLong = false;
  if (text.starts_with('[')) {
    const std::size_t close = text.find(']');
    if (close == std::string_view::npos) return std::nullopt;
    host = text.substr(1, close - 1);
    port = text.substr(close + 1);
    isLong = true;
  } else if (const std::size_t colon = text.find(':'); colon != std::string_view::npos) {
    isLong = text.find(':', colon + 1) != std::string_view::npos;  // an IPv6 number alone
    if (!isLong) {
      host = text.substr(0, colon);
      port = text.substr(colon);
    }
  }
  if (isLong ? !isLongNumber(host) : !isName(host)) return std::nullopt;
  Address address{std::string(host)};
  if (port.empty()) return address;
  const std::optional<int> number = port.front() == ':' ? portFrom(port.substr(1)) : std::nullopt;
  if (!number) return std::nullopt;
  address.port = *number;
  return address;
}

}  // namespace relucent::pjlink
