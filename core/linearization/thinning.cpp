// SPDX-License-Identifier: MIT
#include "relucent/linearization/thinning.h"

#include <algorithm>
#include <utility>

namespace relucent::linearization {
namespace {

constexpr std::size_t mostPixels = 100000;  // of all cameras, that remain

std::size_t quotientUp(std::size_t a, std::size_t b) {
  return (a + b - 1) / b;
}

}  // namespace

Thinning::Thinning(const Rasters& cameras)
    : cameras_(cameras), stride_(std::max<std::size_t>(1, quotientUp(cameras.count(), mostPixels))) {
  std::vector<Size> sizes;
  for (std::size_t camera = 0; camera < cameras.devices(); ++camera) {
    Size size = cameras.size(camera);
    sizes.push_back({static_cast<int>(quotientUp(size.count(), stride_)), 1});
    for (std::size_t i = 0; i < size.count(); i += stride_) {
      Pixel pixel = pixelAt(size, i);
      regions_.push_back(regionsOfCamera * camera +
                         static_cast<std::size_t>(3 * pixel.y / size.height * 3 + 3 * pixel.x / size.width));
    }
  }
  thin_ = Rasters(std::move(sizes));
}

rig::Shot Thinning::of(const rig::Shot& shot) const {
  rig::Shot result{shot.id, shot.fingerprint, {}, shot.exposuresAsked};
  for (const std::vector<rig::RawFrame>& exposure : shot.frames) {
    std::vector<rig::RawFrame>& frames = result.frames.emplace_back();
    for (std::size_t camera = 0; camera < exposure.size(); ++camera) {
      const rig::RawFrame& frame = exposure[camera];
      rig::RawFrame& thin =
          frames.emplace_back(rig::RawFrame{image::Image(thin_.size(camera), 3), frame.bits, frame.seconds});
      for (std::size_t i = 0; i < thin.signal.pixels(); ++i)
        std::ranges::copy(frame.signal.pixel(i * stride_), thin.signal.pixel(i).begin());
    }
  }
  return result;
}

}  // namespace relucent::linearization
