// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace relucent::platform {

/// Where everybody in the networks is reached that this computer is in, IPv4 numbers, each once; its own is
/// none of them.
std::vector<std::string> broadcastAddresses();

}  // namespace relucent::platform
