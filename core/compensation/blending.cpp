// SPDX-License-Identifier: MIT
#include "relucent/compensation/blending.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "relucent/base/parallel.h"
#include "relucent/compensation/lit_by.h"
#include "relucent/compensation/stacks.h"

namespace relucent::compensation {
namespace {

/// 0 at the edge of a picture, 1 at its centre.
double distanceFromEdge(const LitBy& lit, Size size) {
  const double x = std::min(lit.x, size.width - lit.x) / (0.5 * size.width),
               y = std::min(lit.y, size.height - lit.y) / (0.5 * size.height);
  return std::clamp(std::min(x, y), 0.0, 1.0);
}

/// The masks of one row, by direct light; sum 0: there is none.
std::vector<double> rampsOf(const std::vector<LitBy>& lit, const Rasters& projectors) {
  // A pixel on the very edge of the only picture is not dark.
  constexpr double least = 1e-6;
  std::vector<double> ramps(lit.size());
  for (std::size_t k = 0; k < lit.size(); ++k)
    if (lit[k].light > 0.0)
      ramps[k] = std::max(
          least, 0.5 * (1.0 - std::cos(std::numbers::pi * distanceFromEdge(lit[k], projectors.size(k)))));
  return ramps;
}

/// Per camera pixel the projectors' shares of the flood image.
std::vector<double> floodSharesOf(const transport::TransportMatrix& transport, std::size_t row) {
  std::vector<double> shares(transport.projectors().devices());
  const transport::LeafRow leaves = transport.row(row);
  for (std::size_t entry = 0; entry < leaves.size(); ++entry)
    shares[static_cast<std::size_t>(transport.layout().node(leaves.column(entry)).projector)] +=
        std::max(0.0, static_cast<double>(leaves.block(entry).sum()));
  return shares;
}

/// Projectors solved each on its own, the others black.
class OwnSolves {
 public:
  OwnSolves(const Compensator& compensator, const Target& target, const SolverSettings& settings)
      : transport_(compensator.venue().transport),
        target_(target),
        settings_(settings),
        free_(compensator.contentPixelsOf(target)) {
    together_.projector.assign(3 * transport_.projectors().count(), 0.0f);
  }

  /// `asked`: of its light alone.
  void add(std::size_t projector, const CameraStack& asked, Progress& progress) {
    const ProjectorMask own = onlyOf(projector, free_, transport_.projectors());
    const ConstrainedProblem problem{transport_, asked, target_.weight, own, target_.available};
    const SolveResult solved =
        solveConstrained(problem, ProjectorStack(together_.projector.size(), 0.0f), settings_, progress);
    together_.iterations += solved.iterations;
    for (std::size_t j = 0; j < own.size(); ++j) {
      if (own[j] == 0) continue;
      for (std::size_t c = 3 * j; c < 3 * j + 3; ++c) {
        together_.projector[c] = solved.x[c];
        limited_ += solved.x[c] <= 0.0f || solved.x[c] >= 1.0f;
        ++values_;
      }
    }
  }

  Compensation result() const {
    Compensation result = together_;
    if (values_ > 0) result.clipped = static_cast<double>(limited_) / static_cast<double>(values_);
    return result;
  }

 private:
  const transport::TransportMatrix& transport_;
  const Target& target_;
  const SolverSettings& settings_;
  ProjectorMask free_;
  Compensation together_;
  std::size_t limited_ = 0, values_ = 0;
};

}  // namespace

std::vector<std::vector<float>> blendingMasks(const transport::TransportMatrix& transport,
                                              const DirectLightSettings& settings) {
  const Rasters& projectors = transport.projectors();
  const std::size_t rows = transport.cameras().count();
  std::vector<std::vector<float>> masks(projectors.devices(), std::vector<float>(rows, 0.0f));
  const DirectLeaves direct(transport, settings);
  parallelFor(0, rows, 256, [&](std::size_t row) {
    const auto sumOf = [](const std::vector<double>& values) {
      double sum = 0.0;
      for (double value : values) sum += value;
      return sum;
    };
    std::vector<double> shares = rampsOf(litBy(transport, direct, row), projectors);
    if (sumOf(shares) == 0.0) shares = floodSharesOf(transport, row);
    const double all = sumOf(shares);
    if (all == 0.0) return;
    for (std::size_t k = 0; k < masks.size(); ++k) masks[k][row] = static_cast<float>(shares[k] / all);
  });
  return masks;
}

Compensation solvedSeparately(const Compensator& compensator, const Target& target,
                              const SolverSettings& settings, Progress& progress) {
  const Rasters& projectors = compensator.venue().transport.projectors();
  const std::vector<std::vector<float>> masks =
      blendingMasks(compensator.venue().transport, compensator.settings().direct);
  OwnSolves solves(compensator, target, settings);
  for (std::size_t k = 0; k < projectors.devices(); ++k) {
    Progress solving = progress.part(1.0 / static_cast<double>(projectors.devices()), progress.stage());
    solves.add(k,
               stackOf<CameraStack>(target.wanted.size(),
                                    [&](std::size_t i) { return masks[k][i / 3] * target.asked[i]; }),
               solving);
  }
  return solves.result();
}

Compensation solvedAlone(const Compensator& compensator, const Target& target, std::size_t projector,
                         const SolverSettings& settings, Progress& progress) {
  OwnSolves solves(compensator, target, settings);
  solves.add(projector, target.asked, progress);
  return solves.result();
}

}  // namespace relucent::compensation
