// SPDX-License-Identifier: MIT
// What masks leave of every projector pixel's light.
#include <algorithm>
#include <atomic>
#include <functional>

#include "relucent/base/error.h"
#include "relucent/base/parallel.h"
#include "relucent/compensation/mask.h"
#include "relucent/compensation/target.h"

namespace relucent::compensation {
namespace {

/// Of the camera pixel that a projector pixel lights most, what another one must have to count: less than
/// this of a projector pixel's light is the rim of its spot.
constexpr float leastShare = 0.1f;
/// Of its direct light, what a pixel of another view has lost that counts as masked.
constexpr float lostToMasks = 0.9f;

/// The order in which values come makes no difference.
template <typename Compare>
void keep(float& held, float value, const Compare& isBetter) {
  std::atomic_ref<float> place(held);
  float seen = place.load(std::memory_order_relaxed);
  while (isBetter(value, seen) && !place.compare_exchange_weak(seen, value, std::memory_order_relaxed)) {
  }
}

/// B of the rows of a venue's T.
class ShareReader {
 public:
  ShareReader(const MeasuredVenue& venue, const DirectLightSettings& settings)
      : transport_(venue.transport), sees_(seesProjection(venue)), rule_(venue.transport, settings) {}

  /// Calls visit(projector pixel, B_ij) for the direct light of a row.
  template <typename Visit>
  void each(std::size_t row, const Visit& visit) const {
    if (!sees_[row]) return;
    const LookedAtRow leaves(rule_, transport_.row(row));
    float all = 0.0f;
    leaves.eachDirect([&](std::size_t, const LookedAtRow::Leaf& leaf) { all += std::max(0.0f, leaf.sum); });
    if (!(all > 0.0f)) return;
    const Rasters& projectors = transport_.projectors();
    leaves.eachDirect([&](std::size_t, const LookedAtRow::Leaf& leaf) {
      if (!(leaf.light > 0.0f)) return;
      for (int y = leaf.block.y0; y < leaf.block.y1; ++y)
        for (int x = leaf.block.x0; x < leaf.block.x1; ++x)
          visit(projectors.offset(leaf.projector) + indexOf(projectors.size(leaf.projector), {x, y}),
                leaf.light / all);
    });
  }

 private:
  const transport::TransportMatrix& transport_;
  CameraMask sees_;
  DirectLeaves rule_;
};

/// s of the masks that were drawn in each view.
std::vector<float> drawn(const Rasters& cameras, const std::vector<Mask>& masks) {
  std::vector<float> masked(cameras.count(), 0.0f);
  for (const Mask& mask : masks) {
    if (mask.camera >= cameras.devices())
      throw Error(ErrorKind::input,
                  RELUCENT_MESSAGE("compensation.mask-of-no-camera",
                                   "a mask was drawn in the view of camera {}, but there are {} cameras")
                      .with(as::label(mask.camera + 1), as::label(cameras.devices())),
                  RELUCENT_MESSAGE("compensation.draw-masks-of-cameras",
                                   "draw masks in the views of the cameras that measured this calibration"));
    const std::vector<float> shares = sharesOf(mask, cameras.size(mask.camera));
    float* const first = &masked[cameras.offset(mask.camera)];
    std::transform(shares.begin(), shares.end(), first, first,
                   [](float a, float b) { return std::max(a, b); });
  }
  return masked;
}

}  // namespace

MaskedLight maskedLight(const MeasuredVenue& venue, const std::vector<Mask>& masks,
                        const DirectLightSettings& settings) {
  if (masks.empty()) return {};
  const auto wrong = problems(masks);
  require(wrong.empty(), "masks: {}", fmt::join(wrong, "; "));
  const Rasters& cameras = venue.transport.cameras();
  MaskedLight light{drawn(cameras, masks), std::vector<float>(venue.transport.projectors().count(), 1.0f)};
  const ShareReader shares(venue, settings);
  std::vector<bool> isDrawnIn(cameras.devices(), false);
  for (const Mask& mask : masks) isDrawnIn[mask.camera] = true;

  for (std::size_t camera = 0; camera < cameras.devices(); ++camera) {
    if (!isDrawnIn[camera]) continue;
    const std::size_t begin = cameras.offset(camera), end = begin + cameras.size(camera).count();
    std::vector<float> most(light.available.size(), 0.0f);
    parallelFor(begin, end, 256, [&](std::size_t row) {
      shares.each(row, [&](std::size_t j, float share) { keep(most[j], share, std::greater()); });
    });
    parallelFor(begin, end, 256, [&](std::size_t row) {
      if (!(light.masked[row] > 0.0f)) return;
      shares.each(row, [&](std::size_t j, float share) {
        if (share >= leastShare * most[j])
          keep(light.available[j], std::max(0.0f, 1.0f - light.masked[row]), std::less());
      });
    });
  }
  for (std::size_t camera = 0; camera < cameras.devices(); ++camera) {
    const std::size_t begin = cameras.offset(camera), end = begin + cameras.size(camera).count();
    parallelFor(begin, end, 256, [&](std::size_t row) {
      if (light.masked[row] > 0.0f) return;
      float lost = 0.0f;
      shares.each(row, [&](std::size_t j, float share) { lost += share * (1.0f - light.available[j]); });
      if (!isDrawnIn[camera] && lost >= lostToMasks) light.masked[row] = 1.0f;
    });
  }
  return light;
}

}  // namespace relucent::compensation
