// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <utility>

#include "relucent/image/image.h"

namespace relucent::image {

// Positions are continuous: pixel (x, y) covers [x, x + 1) x [y, y + 1), its centre is (x + 0.5, y + 0.5),
// and the image's corners are (0, 0) and (width, height).
using Point = std::array<double, 2>;

/// A plane projective map, row-major: (u, v, w) = H (x, y, 1), maps to (u / w, v / w). The sign of H is such
/// that w > 0 for visible points; points with w <= 0 lie behind the horizon and have no image.
using Homography = std::array<double, 9>;

/// The map that takes the four points `from` to `to`.
/// Throws: Error{input} if three of the points lie on a line.
Homography homographyBetween(const std::array<Point, 4>& from, const std::array<Point, 4>& to);
/// The map that takes an image's corners, clockwise from top left, to `corners`.
Homography homographyFromCorners(Size image, const std::array<Point, 4>& corners);
/// Throws: Error{input} if the map has no inverse.
Homography inverted(const Homography& map);
Point mapped(const Homography& map, Point point);

/// The image at another size: shrunk by area averaging, enlarged bilinearly, each axis separately. Shrinking
/// by whole factors keeps the mean exactly.
Image resized(const Image& image, Size size);

/// The image seen through a perspective map: bilinear at the source of a pixel's centre, with a regular grid
/// of up to 8x8 samples a pixel where the map shrinks. Samples whose source lies outside or behind the
/// horizon count as `outside`.
Image warpedPerspective(const Image& source, const Homography& sourceFromResult, Size size,
                        float outside = 0.0f);

}  // namespace relucent::image
