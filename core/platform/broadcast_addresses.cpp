// SPDX-License-Identifier: MIT
#include "relucent/platform/broadcast_addresses.h"

#include <arpa/inet.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <netinet/in.h>

#include <array>
#include <memory>
#include <set>

namespace relucent::platform {

std::vector<std::string> broadcastAddresses() {
  ifaddrs* all = nullptr;
  if (getifaddrs(&all) != 0) return {};
  const std::unique_ptr<ifaddrs, decltype(&freeifaddrs)> owned(all, &freeifaddrs);
  std::set<std::string> found;
  for (const ifaddrs* one = all; one != nullptr; one = one->ifa_next) {
    const bool reaches = (one->ifa_flags & IFF_UP) != 0 && (one->ifa_flags & IFF_BROADCAST) != 0 &&
                         (one->ifa_flags & IFF_LOOPBACK) == 0;
    if (!reaches || one->ifa_addr == nullptr || one->ifa_addr->sa_family != AF_INET ||
        one->ifa_broadaddr == nullptr)
      continue;
    std::array<char, INET_ADDRSTRLEN> text{};
    const auto* place = reinterpret_cast<const sockaddr_in*>(one->ifa_broadaddr);
    if (inet_ntop(AF_INET, &place->sin_addr, text.data(), text.size()) != nullptr) found.emplace(text.data());
  }
  return {found.begin(), found.end()};
}

}  // namespace relucent::platform
