// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "relucent/rig/rig.h"

namespace relucent::rig {

/// The names of all projectors, for people.
std::string projectorNames(const Rig& rig);

}  // namespace relucent::rig
