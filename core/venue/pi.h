// SPDX-License-Identifier: MIT
#pragma once

#include <numbers>

namespace relucent::venue {

/// In the precision of all that is traced.
inline constexpr float pi = std::numbers::pi_v<float>;

}  // namespace relucent::venue
