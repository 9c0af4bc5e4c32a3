// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "relucent/compensation/direct_light.h"
#include "relucent/transport/transport_matrix.h"

namespace relucent::compensation {

/// Where in the first camera's view lies what a camera pixel sees. Continuous pixels: pixel (x, y) covers
/// [x, x + 1) x [y, y + 1). NaN: not known. Shape: the pixels of all cameras; empty: there is one camera.
using ViewMap = std::vector<std::array<float, 2>>;

/// By the projectors, whose pixels light one place of the surface each, whoever looks at it:
///   a_j = sum_i T_ij x_i / sum_i T_ij        i: usable pixels of the first camera, x_i their places,
///   x_q = sum_j T_qj a_j / sum_j T_qj        q: a usable pixel of another one,
/// over direct light alone (DirectLeaves), and in the second sum over those j whose a_j are near each other.
/// Where the first camera sees less than a quarter of the light that q sees directly, the map goes on
/// smoothly from the pixels around q: what lies there is seen from other places only. From there the next
/// camera has the a_j that are not known yet, so that all that see a place have the same there. Exact where
/// the surface is flat within what a projector pixel lights.  Source: core/compensation/README.md.
ViewMap viewMap(const transport::TransportMatrix& transport, const CameraMask& usable,
                const DirectLightSettings& settings = {});

/// The same for the cameras of another T under the same projectors, by what `views` has of the cameras of the
/// first T.  Shapes: the pixels of `others`.
ViewMap viewMapInto(const transport::TransportMatrix& transport, const CameraMask& usable,
                    const ViewMap& views, const transport::TransportMatrix& others,
                    const CameraMask& usableOthers, const DirectLightSettings& settings = {});

/// a_j: where in the first camera's view lies what each projector pixel lights; NaN: no usable pixel of any
/// camera sees it directly. `views`: as of MeasuredVenue. Shape: the pixels of all projectors.
std::vector<std::array<float, 2>> projectorPlaces(const transport::TransportMatrix& transport,
                                                  const CameraMask& usable, const ViewMap& views,
                                                  const DirectLightSettings& settings = {});

/// Cameras beyond the first in whose view nothing is known: they share no lit place with those before them.
/// Shapes: the pixels of `cameras`.
std::vector<std::size_t> camerasApart(const ViewMap& map, const Rasters& cameras);

/// Between which pixels of the first camera's view a place lies, and their shares, which sum to one.
struct ViewSample {
  std::array<std::size_t, 4> pixel{};
  std::array<float, 4> share{};  // 0 of those that are not `inside`
};
/// None where the place is not known, or its own pixel is not inside. Shape: `inside` of `view` or more.
std::optional<ViewSample> sampleAt(const std::array<float, 2>& place, Size view, const CameraMask& inside);

}  // namespace relucent::compensation
