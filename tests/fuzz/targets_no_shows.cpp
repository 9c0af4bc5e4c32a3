// SPDX-License-Identifier: MIT
#include "fuzz/targets.h"

namespace relucent::fuzz {

std::vector<FuzzTarget> showTargets() {
  return {};
}

}  // namespace relucent::fuzz
