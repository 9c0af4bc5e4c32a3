// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "relucent/base/message.h"
#include "relucent/base/progress.h"
#include "relucent/pjlink/address.h"

namespace relucent::pjlink {

struct SearchSettings {
  std::chrono::milliseconds patience{3000};  // in all; it is asked twice
  /// Who is asked; empty: everybody in the networks that this computer is in, not beyond their routers.
  std::vector<std::string> targets{};
  int port = standardPort;
};
/// Sentences about what cannot be.
std::vector<Message> problems(const SearchSettings& settings);

struct Found {
  Address address;
  std::string hardware;  // "01:23:45:67:89:ab"
  bool operator==(const Found&) const = default;
};

/// Asks for projectors by UDP, which those of class 2 answer (SRCH, ACKN); at most `mostFound`, in the order
/// of their addresses. Class 1 knows no search: such a projector is given by its address. Throws:
/// Error{device} if there is no network to ask in; Cancelled.
std::vector<Found> searchProjectors(const SearchSettings& settings, Progress& progress);
inline constexpr std::size_t mostFound = 256;

}  // namespace relucent::pjlink
