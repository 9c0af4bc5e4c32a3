// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace relucent::platform {

/// Operating system, processor and memory, some lines for whoever looks into a problem from afar.
std::string systemDescription();

}  // namespace relucent::platform
