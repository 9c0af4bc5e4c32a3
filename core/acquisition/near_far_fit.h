// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "relucent/transport/transport_matrix.h"

namespace relucent::acquisition {

/// A pattern, and what camera pixels showed of it.
struct SeenPattern {
  /// Infinite variance: nothing was seen.
  struct Light {
    float radiance = 0.0f, variance = 0.0f;
  };

  const ProjectorStack& pattern;
  std::function<Light(std::size_t value)> shown;  // of a value of a camera stack; called from several threads
};

/// T with the near and the far light of the `rows`, each for itself, times what has become of it by what
/// patterns show: what paint and dust leave of light that a surface scatters is another share than of what it
/// mirrors.
///     y_c = sum_n f_nc L_nc + noise,      f_nc ~ N(1, 0.5^2)
/// L_nc: what T's near or far light of one projector shows of the pattern in the camera's channel c. Per
/// camera pixel and channel two unknowns for each projector. At most a quarter of a gigabyte beside T and a
/// pattern.
transport::TransportMatrix nearAndFarFitted(transport::TransportMatrix transport, const CameraMask& rows,
                                            const std::vector<SeenPattern>& patterns);

}  // namespace relucent::acquisition
