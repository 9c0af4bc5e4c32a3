// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "relucent/base/enum_names.h"
#include "relucent/base/message.h"
#include "relucent/compensation/direct_light.h"

namespace relucent::compensation {

struct MeasuredVenue;

/// How the points of a mask are joined.
enum class Outline { lines, curve };
inline constexpr EnumName<Outline> outlineNames[]{
    {Outline::lines, "lines", "straight lines from point to point"},
    {Outline::curve, "curve", "a smooth closed curve through the points"}};
constexpr EnumNames<Outline> namesOf(Outline) {
  return {"outline", outlineNames};
}

/// A part of a camera's view that no projector is to light: a door, a window, where visitors sit.
struct Mask {
  std::size_t camera = 0;
  Outline outline = Outline::lines;
  /// Closed, in either direction: x and y as shares of the view's width and height, 0 to 1.
  std::vector<std::array<double, 2>> points;
  /// How far beyond the outline the light comes back, as a share of the view's larger side.
  double feather = 0.02;
  bool operator==(const Mask&) const = default;
};

inline constexpr std::size_t mostMaskPoints = 200;
inline constexpr double widestFeather = 0.5;

/// One sentence for each mask that is none: too few points, not finite, outside the view, an outline that
/// crosses itself or encloses nothing.
std::vector<Message> problems(const std::vector<Mask>& masks);
/// What is wrong with the outline of one mask, empty if nothing is: for whoever draws it.
Message outlineProblem(const Mask& mask);

/// The closed outline as a polygon, in the mask's coordinates. A curve is the centripetal Catmull-Rom spline
/// of its points, which has no cusps and no loops within a piece.  Source: Yuksel, Schaefer & Keyser,
/// Parameterization and applications of Catmull-Rom curves, CAD 43, 2011.  Contract: three points or more.
std::vector<std::array<double, 2>> outlineOf(const Mask& mask);

/// How much of each pixel of a view the mask takes: with d the distance from the outline, 0 within it, and f
/// the feather,
///   s = 1 - 3 t^2 + 2 t^3,   t = min(d / f, 1)
/// 1 within the outline, 0 beyond the feather; means over the pixel.  Shape: one value a pixel of the view.
/// Contract: outlineProblem() finds none.
std::vector<float> sharesOf(const Mask& mask, Size view);

/// From here on a pixel counts as masked: it asks for nothing and is in no figure.
inline constexpr float fullyMasked = 0.999f;

/// What masks do to a venue. Both empty: nothing.
struct MaskedLight {
  std::vector<float> masked;     // s, per camera pixel: the most of its view's masks
  std::vector<float> available;  // a, per projector pixel: what is left of its light, 0 to 1
  bool empty() const { return masked.empty(); }
};

/// Of a projector pixel so much may be used that next to none of its direct light falls where a mask is:
///   B_ij = D_ij / sum_j D_ij        D: direct leaves of T (DirectLeaves), sums over the channels
///   a_j  = min { 1 - s_i : B_ij >= 1/10 max_k B_kj },   k, i of one camera, over usable and directly lit
///   pixels
/// A row's own light divides out how bright its surface is, so that a dark door beside a white wall counts as
/// the wall does. In the views of other cameras a pixel is masked where nine tenths of its direct light are
/// gone. Only direct light: one dim bounce does not darken a wall.  Source: core/compensation/README.md.
/// Throws: Error{input} for a mask of a camera that there is not. Contract: problems() finds none.
MaskedLight maskedLight(const MeasuredVenue& venue, const std::vector<Mask>& masks,
                        const DirectLightSettings& settings = {});

}  // namespace relucent::compensation
