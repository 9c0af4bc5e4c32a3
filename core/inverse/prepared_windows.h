// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "relucent/base/progress.h"
#include "relucent/inverse/near_field.h"
#include "relucent/inverse/windows.h"

namespace relucent::inverse {

/// The part of the windows of one T that does not depend on the ridge: steps 1 to 3 of computeWindows(),
/// about half of its work. For the search of a ridge. `transport` must outlive it.
class PreparedWindows {
 public:
  /// `settings.ridge` is ignored.
  PreparedWindows(const transport::TransportMatrix& transport, const CameraMask& usable,
                  const WindowSettings& settings, Progress& progress);

  /// Steps 4 and 5. Same bits as computeWindows() with that ridge.
  /// Throws: Error{numerics} if a G is not positive definite; Cancelled.
  WindowInverse inverse(double ridge, Progress& progress) const;

  /// Steps 4 and 5 again with another ridge for some tiles, counted as in WindowArrays::tiles, of windows
  /// that these made. Throws: as inverse(), the tiles before the one that failed being done.
  void renew(WindowInverse& windows, double ridge, std::span<const std::uint32_t> tiles,
             Progress& progress) const;

  /// All tiles, in order.
  std::vector<std::uint32_t> allTiles() const;

  /// Everything but the weights.
  WindowArrays view() const { return without_.view(); }

 private:
  const transport::NodeLayout& layout_;
  NearField near_;
  WindowInverse without_;  // everything but the weights
};

}  // namespace relucent::inverse
