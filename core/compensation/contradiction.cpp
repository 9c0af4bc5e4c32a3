// SPDX-License-Identifier: MIT
#include "relucent/compensation/contradiction.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "relucent/base/parallel.h"
#include "relucent/compensation/stacks.h"
#include "relucent/image/colour.h"

namespace relucent::compensation {
namespace {

constexpr double toldShare = 0.05;

/// What the cameras see after the steps with these weights, from the same start.
CameraStack seenAfterSteps(const Compensator& compensator, const CameraStack& wantedLessBlack,
                           const std::vector<float>& weight, const ProjectorMask& free,
                           std::span<const float> available, ProjectorStack p, const Progress& progress) {
  const MeasuredVenue& venue = compensator.venue();
  const ConstrainedProblem problem{venue.transport, wantedLessBlack, weight, free, available};
  const ProjectorStack c = diagonalPreconditioner(problem);
  for (float step : compensator.settings().steps) {
    progress.checkpoint();
    takeStep(problem, c, step, p);
    for (std::size_t j = 0; j < p.size(); ++j) p[j] = std::clamp(p[j], 0.0f, problem.most(j / 3));
  }
  CameraStack seen = venue.transport.apply(p);
  parallelFor(0, seen.size(), 4096, [&](std::size_t i) { seen[i] += venue.black[i]; });
  return seen;
}

}  // namespace

Contradiction contradictionOf(const Compensator& compensator, const Target& target,
                              const Compensation& compensation, Progress& progress) {
  const MeasuredVenue& venue = compensator.venue();
  const Rasters& cameras = venue.transport.cameras();
  Contradiction result;
  result.shares.assign(cameras.devices(), 0.0);
  for (std::size_t camera = 0; camera < cameras.devices(); ++camera)
    result.worse.emplace_back(cameras.size(camera), 1, std::numeric_limits<float>::quiet_NaN());
  const auto asking = std::ranges::count_if(target.viewWeight, [](float weight) { return weight > 0.0f; });
  if (asking < 2) return result;

  const ProjectorMask free = compensator.contentPixelsOf(target);
  const auto seenWith = [&](const std::vector<float>& weight) {
    return seenAfterSteps(compensator, target.asked, weight, free, target.available, compensation.projector,
                          progress);
  };
  const auto errorOf = [&](const CameraStack& seen, std::size_t camera, const CameraMask& mask) {
    return image::deltaEMap(
        image::viewed(underEvenWhite(seen, target, cameras, camera), target.white),
        image::viewed(underEvenWhite(target.wanted, target, cameras, camera), target.white), mask);
  };

  const CameraStack together = seenWith(target.weight);
  std::size_t allWorse = 0, all = 0;
  for (std::size_t camera = 0; camera < cameras.devices(); ++camera) {
    progress.report(static_cast<double>(camera + 1) / static_cast<double>(cameras.devices() + 1));
    if (!(target.viewWeight[camera] > 0.0f)) continue;
    CameraMask mask(cameras.size(camera).count());
    for (std::size_t i = 0; i < mask.size(); ++i) {
      const std::size_t row = cameras.offset(camera) + i;
      mask[i] = target.inside[row] != 0 && venue.usable[row] != 0;
    }
    if (std::ranges::count(mask, 0) == std::ssize(mask)) continue;
    const CameraStack alone = seenWith(onlyOf(camera, target.weight, cameras));
    const image::Image dearer = errorOf(together, camera, mask), cheaper = errorOf(alone, camera, mask);
    std::size_t worse = 0, pixels = 0;
    for (std::size_t i = 0; i < mask.size(); ++i) {
      if (mask[i] == 0) continue;
      const float difference = dearer.data()[i] - cheaper.data()[i];
      result.worse[camera].data()[i] = difference;
      ++pixels;
      worse += static_cast<double>(difference) > visibleContradiction;
    }
    result.shares[camera] = static_cast<double>(worse) / static_cast<double>(pixels);
    allWorse += worse;
    all += pixels;
  }
  if (all > 0) result.share = static_cast<double>(allWorse) / static_cast<double>(all);
  progress.report(1.0);
  return result;
}

std::vector<Message> viewNotes(const MeasuredVenue& venue, const Target& target,
                               const Contradiction& contradiction) {
  std::vector<Message> notes;
  const Rasters& cameras = venue.transport.cameras();
  for (std::size_t camera = 1; camera < cameras.devices(); ++camera) {
    const std::span<const std::uint8_t> inside(target.inside.data() + cameras.offset(camera),
                                               cameras.size(camera).count());
    if (target.viewWeight[camera] > 0.0f && std::ranges::count(inside, 0) == std::ssize(inside))
      notes.push_back(
          RELUCENT_ENGLISH_MESSAGE("compensation.view-without-content",
                                   "camera {} sees none of the places where the picture lies for camera 1: "
                                   "give it a picture of its own, or aim it there and measure again")
              .with(as::label(camera + 1)));
  }
  if (hasOwnPictures(target) && contradiction.share >= toldShare)
    notes.push_back(
        RELUCENT_ENGLISH_MESSAGE("compensation.views-contradict",
                                 "the views contradict each other: {} % of their pixels are visibly worse "
                                 "than each would be alone; let the picture lie on the surface, or give the "
                                 "view that matters most more weight")
            .with(as::share(contradiction.share, as::decimals(0))));
  return notes;
}

}  // namespace relucent::compensation
