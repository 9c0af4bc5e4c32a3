// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>

namespace relucent {

/// The methods of compensation, ordered by how much of the light transport they use.
enum class Method { none, scalar, mix, sharpen, clusters, windows, refined, optimum };

/// An available method of compensation.
struct MethodDescription {
  Method method;
  std::string_view name;      // as on the command line
  std::string_view sentence;  // what it does
};

/// All methods: the single list from which names, help, reports and comparisons are made.
inline constexpr std::array methodDescriptions{
    MethodDescription{Method::none, "none", "the picture warped into place, nothing corrected"},
    MethodDescription{Method::scalar, "scalar", "each pixel's brightness corrected on its own"},
    MethodDescription{Method::mix, "mix", "each pixel's colour corrected on its own, by its 3x3 mixing"},
    MethodDescription{Method::sharpen, "sharpen",
                      "mix, and the projector's defocus sharpened; no indirect light"},
    MethodDescription{Method::clusters, "clusters",
                      "the light transport cut into clusters, each inverted (Wetzstein & Bimber 2007)"},
    MethodDescription{Method::windows, "windows", "overlapping regularised inverses of the light transport"},
    MethodDescription{Method::refined, "refined", "windows and constrained steps: the one for video"},
    MethodDescription{Method::optimum, "optimum",
                      "the constrained optimum: the best for still pictures, the slowest"}};

inline constexpr auto allMethods = [] {
  std::array<Method, methodDescriptions.size()> methods{};
  std::transform(methodDescriptions.begin(), methodDescriptions.end(), methods.begin(),
                 [](const MethodDescription& description) { return description.method; });
  return methods;
}();

constexpr std::string_view toString(Method method) {
  for (const MethodDescription& description : methodDescriptions)
    if (description.method == method) return description.name;
  return {};
}

constexpr std::optional<Method> methodFromName(std::string_view name) {
  for (const MethodDescription& description : methodDescriptions)
    if (description.name == name) return description.method;
  return std::nullopt;
}

}  // namespace relucent
