// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "base/progress.h"
#include "inverse/near_field.h"
#include "inverse/windows.h"

namespace relucent {

/// The part of the windows of one T that does not depend on the ridge: steps 1 to 3 of computeWindows(),
/// about half of its work. For the search of a ridge. `transport` must outlive it.
class PreparedWindows {
 public:
  /// `settings.ridge` is ignored.
  PreparedWindows(const TransportMatrix& transport, const std::vector<std::uint8_t>& usable,
                  const WindowSettings& settings, Progress& progress);

  /// Steps 4 and 5. Same bits as computeWindows() with that ridge.
  /// Throws: Error{numerics} if a G is not positive definite; Cancelled.
  WindowInverse inverse(double ridge, Progress& progress) const;

 private:
  const NodeLayout& layout_;
  NearField near_;
  WindowInverse without_;  // everything but the weights
};

}  // namespace relucent
