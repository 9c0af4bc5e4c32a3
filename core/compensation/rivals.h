// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>
#include <functional>
#include <memory>
#include <vector>

#include "relucent/base/enum_names.h"
#include "relucent/compensation/methods.h"

namespace relucent::compensation {

/// What others do, at its best: beyond the older ones among the methods, for comparison. Some take
/// photographs of their own in the venue.
enum class Rival { corrected, robust, deconvolved };
inline constexpr EnumName<Rival> rivalNames[]{
    {Rival::corrected, "corrected", "mix, then corrected by photographs of what came of it"},
    {Rival::robust, "robust",
     "each pixel's colour by a spline through photographs of even colours (Grundhoefer & Iwai 2015)"},
    {Rival::deconvolved, "deconvolved", "sharpen, to its end: the projector's whole defocus undone"}};
constexpr EnumNames<Rival> namesOf(Rival) {
  return {"rival", rivalNames};
}

struct RivalSettings {
  int corrections = 4;  // photographs of each picture that `corrected` takes
  int levels = 4;       // of each colour that `robust` photographs, all combinations
  /// Of the spline of `robust`, see there: what a sample may be off, against the scale of a pixel's own
  /// light.
  double smoothing = 0.01;
};
std::vector<Message> problems(const RivalSettings& settings);

/// What the cameras see of linear drive: radiance, e included.
using Photograph = std::function<CameraStack(const ProjectorStack&)>;

/// With o = target.wanted, e, B and i*(j) as in Compensator::solve():
///   corrected    p_0 = mix,  p_{k+1} = clamp01(p_k + B^-1 (o - photograph of p_k) at i*(j))
///                                                       [Grossberg et al. 2004, Fujii et al. 2005]
///   robust       p_j = f_i(o_i) at i = i*(j), f_i the spline from the colours x_m that camera pixel i saw to
///                the even colours d_m that were shown all over the projectors: the smoothest
///                  f(x) = a_0 + A x - sum_m w_m |x - x_m|,  sum_m w_m = 0,  sum_m w_m x_m^T = 0,
///                that goes by f(x_m) + smoothing w_m = d_m; x over what white gave there
///                                                       [Grundhoefer & Iwai 2015; Wahba 1990]
///   deconvolved  argmin 1/2 sum w |D p - asked|^2 over 0 <= p <= 1, D as in defocusOnly(), converged
/// Prepared once for a venue; `robust` takes its photographs when it is first asked for.
class RivalCompensator {
 public:
  /// `compensator` and `inverse` must outlive it. Throws: std::logic_error for wrong settings.
  RivalCompensator(const Compensator& compensator, const inverse::WindowInverse& inverse,
                   Photograph photograph, RivalSettings settings = {});

  /// Throws: Cancelled; as the photographs do; as Compensator::solve().
  Compensation solve(Rival rival, const Target& target, Progress& progress);
  /// How many were taken of the venue for `rival`: by its solves so far, or, of `robust`, before the first.
  int photographs(Rival rival) const { return taken_[static_cast<std::size_t>(rival)]; }

 private:
  Compensation corrected(const Target& target, Progress& progress);
  Compensation robust(const Target& target, Progress& progress);
  void photographColours(Progress& progress);
  CameraStack photographed(Rival rival, const ProjectorStack& p);

  const Compensator& compensator_;
  const inverse::WindowInverse& inverse_;
  Photograph photograph_;
  RivalSettings settings_;
  std::array<int, 3> taken_{};
  std::vector<Eigen::Vector3d> shown_;     // d_m
  std::vector<CameraStack> seen_;          // x_m of all pixels
  std::unique_ptr<Compensator> sharpest_;  // of `deconvolved`
};

}  // namespace relucent::compensation
