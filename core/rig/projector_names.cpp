// SPDX-License-Identifier: MIT
#include "relucent/rig/projector_names.h"

namespace relucent::rig {

std::string projectorNames(const Rig& rig) {
  std::string names;
  for (const auto& projector : rig.projectors) names += (names.empty() ? "" : ", ") + projector->name();
  return names;
}

}  // namespace relucent::rig
