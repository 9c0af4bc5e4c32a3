// SPDX-License-Identifier: MIT
#pragma once

#include "relucent/base/enum_names.h"

namespace relucent::compensation {

/// The methods of compensation, ordered by how much of the light transport they use.
enum class Method { none, scalar, mix, sharpen, clusters, windows, refined, optimum };

/// The single list from which names, help, reports and comparisons are made.
inline constexpr EnumName<Method> methodNames[]{
    {Method::none, "none", "the picture warped into place, nothing corrected"},
    {Method::scalar, "scalar", "each pixel's brightness corrected on its own"},
    {Method::mix, "mix", "each pixel's colour corrected on its own, by its 3x3 mixing"},
    {Method::sharpen, "sharpen", "mix, and the projector's defocus sharpened; no indirect light"},
    {Method::clusters, "clusters",
     "the light transport cut into clusters, each inverted (Wetzstein & Bimber 2007)"},
    {Method::windows, "windows", "overlapping regularised inverses of the light transport"},
    {Method::refined, "refined", "windows and constrained steps: the one for video"},
    {Method::optimum, "optimum", "the constrained optimum: the best for still pictures, the slowest"}};
constexpr EnumNames<Method> namesOf(Method) {
  return {"method", methodNames};
}

}  // namespace relucent::compensation
