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

  /// The same, see renewWindows(). Contract: `former` was made with that ridge.
  WindowInverse inverse(double ridge, const WindowInverse& former, const CameraMask& changed,
                        Progress& progress) const;

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

/// What computeWindows() makes, to the bit, of a T of which most is as it was when `former` was made with the
/// same settings: only windows that have camera pixels which are marked, or others than before, are solved.
/// `changed`: camera pixels whose row of T (transport::differingRows()) or `usable` is another. Throws: as
/// computeWindows(); std::logic_error if `former` has other tiles.
WindowInverse renewWindows(const WindowInverse& former, const CameraMask& changed,
                           const transport::TransportMatrix& transport, const CameraMask& usable,
                           const WindowSettings& settings, Progress& progress);

}  // namespace relucent::inverse
