// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <mutex>
#include <string>
#include <vector>

#include "relucent/base/progress.h"
#include "relucent/compensation/direct_light.h"
#include "relucent/compensation/method.h"
#include "relucent/compensation/solver.h"
#include "relucent/compensation/step_preconditioner.h"
#include "relucent/compensation/target.h"
#include "relucent/inverse/cluster_inverse.h"
#include "relucent/inverse/windows.h"

namespace relucent::compensation {

struct CompensatorSettings {
  /// Settings of `clusters`. Without a cap, clusters percolate in almost every venue.
  clustering::ClusteringSettings clustering{.patchCut = 0.3, .cap = clustering::SizeCap::always};
  inverse::ClusterInverseSettings clusterInverse{.ridge = 2.0};
  /// The correction step of `windows` and `clusters`: share of M W r, and of C T^T W r.
  float correctionByInverse = 0.5f;
  float correctionByAdjoint = 1.0f;
  /// a_k of `refined`, in pairs: short steps settle components that T passes in full (low frequencies), long
  /// ones reach those that it attenuates. |prod (1 - a_k s)| <= 1 for all 0 <= s <= 1, the spectrum of C T^T
  /// W T, after any number of steps: no component grows.
  std::vector<float> steps = {1.2f, 5.0f, 1.2f, 3.0f, 1.2f, 10.0f, 1.2f, 5.0f, 1.2f, 3.0f, 1.2f, 20.0f};
  /// Not to the end: from here on, steps follow the errors of T. The tolerance, of drive values, is one that
  /// dark pictures do not meet at once.  Source: core/compensation/README.md.
  SolverSettings optimum{.mostIterations = 60, .tolerance = 1e-5};
  /// Of `sharpen`: steepest descent, as in Zhang & Nayar.
  SolverSettings sharpening{SolverSettings::Algorithm::steepestDescent, 20};
  DirectLightSettings direct;  // reach of the defocus in `sharpen`
};
std::vector<Message> problems(const CompensatorSettings& settings);

/// What to project.
struct Compensation {
  ProjectorStack projector;  // linear drive, 0 to 1
  double clipped = 0;        // share of the content's projector values that the projector's limits cut off
  int iterations = 0;        // pairs of products with T and T^T
};

/// Turns targets into projector images. Prepared once for a venue.
/// Projector pixels whose brightest camera pixel lies outside the content stay black, and so do those that no
/// usable camera pixel sees (contentCorrespondence()).
/// `venue` and `inverse` must outlive it.
class Compensator {
 public:
  Compensator(const MeasuredVenue& venue, const inverse::WindowInverse& inverse,
              CompensatorSettings settings = {});

  /// With o = target.wanted, a = target.asked, W = target.weight, V = target.windowsWeight, i*(j) = the
  /// brightest camera pixel of projector pixel j, B = the row sums of T:
  ///   none     b content at i*(j) as drive: geometric warp only, under the single best brightness
  ///            b = <F c, a> / <F c, F c>, at most 1   (F flood, c content, pixels inside)
  ///   scalar   (o - e) / flood at i*(j), channel by channel                    [Bimber et al. 2005]
  ///   mix      B^-1 (o - e) at i*(j)                        [Nayar et al. 2003, Grossberg et al. 2004]
  ///   sharpen  mix, then the constrained optimum through the defocus alone, see defocusOnly(): no light goes
  ///            further than the direct light does                             [Zhang & Nayar 2006]
  ///   clusters the same as windows with M = T+ of Algorithm 1's clusters, held to a size
  ///                                                                           [Wetzstein & Bimber 2007]
  ///   windows  p = clamp01(M r), r = o - e held between 0 and flood, then
  ///            p <- clamp01(p + (m M V + n C T^T W) (r - T p)): a window knows its own neighbourhood, T the
  ///            whole venue; the adjoint takes back light where many pixels' light meets (caustics)
  ///   refined  windows, then p <- clamp01(p + a_k C T^T W (a - T p)) for every a_k
  ///   optimum  the constrained least-squares solution, started from windows
  /// C: of windows, clusters and refined StepPreconditioner's. Where target.available holds light back, a =
  /// it: T diag(a) in place of T, as if a filter hung before the projector, and p <= a, see
  /// engine/availability.h. `clusters` is prepared when it is first asked for. Throws: Cancelled;
  /// Error{numerics} where solveConstrained() does; as computeClusterInverse().
  Compensation solve(Method method, const Target& target, Progress& progress) const;

  /// From p on, `rounds` times the steps of `refined`, of whatever made p.
  /// Throws: Cancelled.
  Compensation goOn(const Target& target, Compensation p, int rounds, Progress& progress) const;

  const MeasuredVenue& venue() const { return venue_; }
  const CompensatorSettings& settings() const { return settings_; }
  /// The projector pixels of the content; the others stay black.
  ProjectorMask contentPixelsOf(const Target& target) const;
  /// i*(j) of all views, -1 where no usable camera pixel sees projector pixel j.
  const std::vector<std::int32_t>& brightestCameraPixel() const { return brightest_; }

 private:
  /// `brightest`: the camera pixels that projector pixels answer to.
  ProjectorStack perPixel(Method method, const Target& target,
                          const std::vector<std::int32_t>& brightest) const;
  /// Improves the projection of `mix` with the defocus of T.
  Compensation sharpened(const Target& target, Compensation mixed, const ProjectorMask& free,
                         Progress& progress) const;
  /// The factor for which flood * content is closest to the wanted image in least squares, at most 1.
  float bestBrightness(const Target& target) const;
  /// Clamped M b, corrected once. `free`: projector pixels of the content; `preconditioner`: C.
  Compensation byInverse(const std::function<ProjectorStack(const CameraStack&)>& inverse,
                         const Target& target, const ProjectorMask& free,
                         const ProjectorStack& preconditioner, const Progress& progress) const;
  const inverse::ClusterInverse& clusters(Progress& progress) const;
  /// The steps of `refined`, `rounds` times. `preconditioner`: C.
  void takeSteps(const ConstrainedProblem& problem, const ProjectorStack& preconditioner, int rounds,
                 const std::vector<float>& available, Compensation& p, Progress& progress) const;

  const MeasuredVenue& venue_;
  const inverse::WindowInverse& inverse_;
  CompensatorSettings settings_;
  std::vector<std::int32_t> brightest_;
  std::vector<transport::ColourBlock> mixing_;
  StepPreconditioner preconditioner_;
  mutable std::once_flag clustersMade_;
  mutable inverse::ClusterInverse clusters_;
};

}  // namespace relucent::compensation
