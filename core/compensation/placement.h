// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "image/image.h"

namespace relucent {

/// Corners of a quadrilateral, clockwise from top left. Continuous pixel coordinates: pixel (x, y) covers
/// [x, x + 1) x [y, y + 1).
using Corners = std::array<std::array<double, 2>, 4>;

/// The corners of an upright rectangle.
Corners uprightCorners(double x, double y, double width, double height);

/// Whether the corners turn clockwise all the way round, with an area worth the name.
bool isConvex(const Corners& corners);

/// The projective map that takes the corners to the unit square's (0,0), (1,0), (1,1), (0,1).
/// Contract: isConvex(corners).
Eigen::Matrix3d unitSquareFrom(const Corners& corners);

/// The largest upright rectangle of shape `aspect` (width / height) that lies in usable pixels. Small holes
/// do not count: 90 % of the rectangle, and 90 % of a strip along each of its sides, must be usable. Of
/// equally large ones the one with most usable pixels, then the one nearest to the middle of the view.
/// Nothing if no rectangle at least 4 pixels high fits.
std::optional<Corners> largestUpright(const std::vector<std::uint8_t>& usable, Size size, double aspect);

/// Content placed into a view: pixel centres within the corners are inside, and show the mean of the content
/// over the area that the pixel covers (at the border the content's edge pixels continue outward).
struct Placed {
  Image image;  // 0 outside
  std::vector<std::uint8_t> inside;
};
Placed place(const Image& content, const Corners& corners, Size view);

}  // namespace relucent
