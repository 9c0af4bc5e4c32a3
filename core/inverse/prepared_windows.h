// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "base/progress.h"
#include "inverse/near_field.h"
#include "inverse/windows.h"

namespace relucent {

/// What the windows of one T have in common whatever their ridge: steps 1 to 3 of computeWindows(), about
/// half of its work. For trying ridges. `transport` must outlive it.
class PreparedWindows {
 public:
  /// `settings.ridge` is not looked at.
  PreparedWindows(const TransportMatrix& transport, const std::vector<std::uint8_t>& usable,
                  const WindowSettings& settings, Progress& progress);

  /// Steps 4 and 5. Same bits as computeWindows() with that ridge.
  /// Throws: Error{numerics} if a G is not positive definite; Cancelled.
  WindowInverse inverse(double ridge, Progress& progress) const;

 private:
  const NodeLayout& layout_;
  NearField near_;
  WindowInverse without_;  // all of it but the weights
};

}  // namespace relucent
