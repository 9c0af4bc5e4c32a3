// SPDX-License-Identifier: MIT
#include "wizard/devices/camera_ranking.h"

#include <algorithm>
#include <cmath>

#include "relucent/base/error.h"

namespace relucent::gui {
namespace {

constexpr double muchWider = 2.0;

/// How many times longer the longest exposure is than the shortest.
double range(const devices::ListedCamera& camera) {
  const rig::ExposureRange& exposures = camera.traits.exposures;
  return exposures.shortest > 0.0 ? exposures.longest / exposures.shortest : 0.0;
}

/// In steps of `muchWider`, so that the order is one.
int rangeStep(const devices::ListedCamera& camera) {
  return static_cast<int>(std::floor(std::log(std::max(range(camera), 1.0)) / std::log(muchWider)));
}

bool comesBefore(const devices::ListedCamera& a, const devices::ListedCamera& b) {
  if (a.usable != b.usable) return a.usable;
  if (!a.usable) return false;
  if (a.traits.format.bits != b.traits.format.bits) return a.traits.format.bits > b.traits.format.bits;
  if (rangeStep(a) != rangeStep(b)) return rangeStep(a) > rangeStep(b);
  return a.traits.size.count() > b.traits.size.count();
}

}  // namespace

void rank(std::vector<devices::ListedCamera>& cameras) {
  std::ranges::stable_sort(cameras, comesBefore);
}

CameraMerit meritOver(const devices::ListedCamera& better, const devices::ListedCamera& other) {
  if (better.traits.format.bits > other.traits.format.bits) return CameraMerit::bits;
  if (rangeStep(better) > rangeStep(other)) return CameraMerit::exposures;
  if (better.traits.size.count() > other.traits.size.count()) return CameraMerit::pixels;
  return CameraMerit::none;
}

CameraMerit meritOf(const std::vector<devices::ListedCamera>& ranked, std::size_t camera) {
  require(camera < ranked.size() && ranked[camera].usable, "camera {} of {}", camera, ranked.size());
  if (camera > 0) return meritOver(ranked.front(), ranked[camera]);
  if (ranked.size() == 1 || !ranked[1].usable) return CameraMerit::alone;
  return meritOver(ranked[0], ranked[1]);
}

}  // namespace relucent::gui
