// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

#include "relucent/compensation/methods.h"
#include "relucent/image/image.h"

namespace relucent::mapping {

/// What other players need to know of a venue: which place of the content each projector pixel shows, and how
/// brightly. They show  p_j = alpha_j content(u_j), channel by channel, in linear light.
struct ProjectorMaps {
  Rasters projectors;
  /// u_j in the content: (0, 0) its upper left corner, (1, 1) its lower right one. Beyond what any camera
  /// sees as the nearest pixel that is seen, so that players may interpolate.
  std::vector<std::array<float, 2>> place;
  ProjectorStack alpha;  // 0 to 1; 0 where nothing of the content is shown
};

/// u_j by the light that j sends directly (compensation::projectorPlaces()), through the content's placement
/// in the first camera's view; alpha the compensation *refined* of content that is white everywhere, so that
/// with it white is white: T alpha + e = wanted, whatever the surface, the light that comes back from it, and
/// the number of projectors. `canvas`: the content's pixels, for its shape.
/// Throws: as fitTarget() and Compensator::solve(); Error{input} if views have pictures of their own: one
/// content has one place a projector pixel.  Source: core/mapping/README.md.
ProjectorMaps projectorMaps(const compensation::Compensator& compensator, Size canvas,
                            const compensation::TargetSettings& settings, Progress& progress);

/// What a player shows with them: content between its pixels' centres linearly, beyond them as at the edge.
ProjectorStack shownBy(const ProjectorMaps& maps, const image::Image& linearContent);

}  // namespace relucent::mapping
