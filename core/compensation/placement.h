// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "relucent/base/enum_names.h"
#include "relucent/image/image.h"

namespace relucent::compensation {

/// Corners of a quadrilateral, clockwise from top left. Continuous pixel coordinates: pixel (x, y) covers
/// [x, x + 1) x [y, y + 1).
using Corners = std::array<std::array<double, 2>, 4>;

/// The corners of an upright rectangle.
Corners uprightCorners(double x, double y, double width, double height);

/// Whether the corners form a convex clockwise quadrilateral with a significant area.
bool isConvex(const Corners& corners);

/// The projective map that takes the corners to the unit square's (0,0), (1,0), (1,1), (0,1).
/// Contract: isConvex(corners).
Eigen::Matrix3d unitSquareFrom(const Corners& corners);

/// The largest upright rectangle of shape `aspect` (width / height) that lies in usable pixels. Small holes
/// do not count: 90 % of the rectangle, and 90 % of a strip along each of its sides, must be usable. Of
/// equally large ones the one with most usable pixels, then the one nearest to the centre of the view. Empty
/// if no rectangle at least 4 pixels high fits.
std::optional<Corners> largestUpright(const CameraMask& usable, Size size, double aspect);

/// How content is fitted to a quadrilateral of another aspect ratio.
enum class Fit {
  fill,   // stretched
  fit,    // the whole content, with bars that are not content
  cover,  // the whole quadrilateral, content cropped on two sides
};
inline constexpr EnumName<Fit> fitNames[]{
    {Fit::fill, "fill", "stretched"}, {Fit::fit, "fit", "leaves bars"}, {Fit::cover, "cover", "cuts off"}};
constexpr EnumNames<Fit> namesOf(Fit) {
  return {"fit", fitNames};
}

/// A part of an image, relative to its width and height.
struct ImagePart {
  double x0 = 0.0, y0 = 0.0, x1 = 1.0, y1 = 1.0;
};

/// Which part of the content lands where.
struct Placement {
  Corners corners{};
  ImagePart part;
};

/// The placement of content of shape `aspect` (width / height) in a quadrilateral. Centred. The shape of a
/// quadrilateral is the mean length of its upper and lower edge over that of the others; the bars of `fit`
/// and the crops of `cover` follow its perspective. Contract: isConvex(quadrilateral), aspect > 0.
Placement fitted(const Corners& quadrilateral, double aspect, Fit fit);

/// Content placed into a view: pixel centres within the corners are inside, and show the mean of the content
/// over the area that the pixel covers (at the border the content's edge pixels continue outward).
struct Placed {
  image::Image image;  // 0 outside
  CameraMask inside;
};
Placed place(const image::Image& content, const Placement& placement, Size view);

}  // namespace relucent::compensation
