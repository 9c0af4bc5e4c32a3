// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "relucent/linearization/mosaic_photographs.h"
#include "relucent/linearization/response_fit.h"

namespace relucent::linearization {

/// What is known of a response while it is being measured: enough to tell how bright a level will be.
class ResponseForecast {
 public:
  /// `light` of the levels that one projector has shown.
  ResponseForecast(const ShownLevels& shown, std::size_t projector, LevelLights light);

  /// Relative to full drive, as the power law between the two lowest levels that were seen goes on.
  double lightAt(std::size_t channel, double drive) const;

 private:
  std::vector<double> drives_;
  LevelLights light_;
  std::array<std::vector<bool>, 3> seen_;
};

}  // namespace relucent::linearization
