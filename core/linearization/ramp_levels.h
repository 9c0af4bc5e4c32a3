// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <deque>
#include <functional>
#include <vector>

#include "relucent/base/random.h"
#include "relucent/linearization/linearization.h"
#include "relucent/linearization/response_fit.h"

namespace relucent::linearization {

/// Drive levels in ascending order, without 0, exact codes of the projector.
std::vector<double> rampLevels(const LinearizationSettings& settings, int bits);

/// Which levels of a projector's ramps mosaics show next: of every channel from the highest down, without the
/// full one. A level is counted from 1 as in MosaicLevels.
class LevelQueue {
 public:
  LevelQueue(std::size_t levels, std::size_t groups, Random random);

  bool isOpen() const;
  /// The highest of a channel that is still open; 0: none.
  std::size_t next(std::size_t channel) const { return open_[channel].empty() ? 0 : open_[channel].front(); }
  std::size_t left(std::size_t channel) const { return open_[channel].size(); }

  /// Enters one channel's next levels into `levels`, in random groups, while `wanted` says so of a level; one
  /// group is `full` if `reference`.
  void show(MosaicLevels& levels, std::size_t channel, bool reference, std::size_t full,
            const std::function<bool(std::size_t)>& wanted);

 private:
  std::array<std::deque<std::size_t>, 3> open_;
  std::size_t groups_;  // of the mosaics
  Random random_;
};

}  // namespace relucent::linearization
