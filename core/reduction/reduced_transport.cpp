// SPDX-License-Identifier: MIT
#include "relucent/reduction/reduced_transport.h"

#include <algorithm>
#include <utility>

#include "relucent/base/error.h"
#include "relucent/image/image.h"
#include "relucent/reduction/reduced_rig.h"

namespace relucent::reduction {
namespace {

Rasters fullRasters(const std::vector<Reduction>& reductions) {
  std::vector<Size> sizes;
  for (const Reduction& reduction : reductions) sizes.push_back(reduction.camera);
  return Rasters(std::move(sizes));
}

}  // namespace

CameraStack reducedRadiance(const CameraStack& radiance, const std::vector<Reduction>& reductions) {
  if (reductions.empty()) return radiance;
  const Rasters full = fullRasters(reductions);
  std::vector<image::Image> images;
  for (std::size_t camera = 0; camera < reductions.size(); ++camera)
    images.push_back(Reducer(reductions[camera]).radiance(image::imageFromStack(radiance, full, camera)));
  return CameraStack(image::stackFromImages(images, reducedRasters(reductions)));
}

transport::TransportMatrix reducedTransport(const transport::TransportMatrix& transport,
                                            const std::vector<Reduction>& reductions) {
  if (reductions.empty()) return transport;
  const Rasters full = fullRasters(reductions), small = reducedRasters(reductions);
  require(full == transport.cameras(), "{} reduced cameras are not those of T", reductions.size());

  // Every row, where it goes and how much it counts there.
  auto forRows = [&](const auto& take) {
    for (std::size_t camera = 0; camera < reductions.size(); ++camera) {
      const Reduction& reduction = reductions[camera];
      const double share = 1.0 / (reduction.bin * reduction.bin * (reduction.bin > 1 ? reduction.clip : 1.0));
      for (int y = 0; y < reduction.part.height; ++y)
        for (int x = 0; x < reduction.part.width; ++x)
          take(
              full.offset(camera) + indexOf(reduction.camera, {reduction.begin.x + x, reduction.begin.y + y}),
              small.offset(camera) + indexOf(reduction.size(), {x / reduction.bin, y / reduction.bin}),
              static_cast<float>(share));
    }
  };
  std::vector<float> fullScale(small.count(), 0.0f);
  forRows([&](std::size_t from, std::size_t to, float share) {
    const transport::LeafRow leaves = transport.row(from);
    float largest = 0.0f;
    for (std::size_t entry = 0; entry < leaves.size(); ++entry)
      largest = std::max(largest, leaves.sizeOf(entry).largest);
    fullScale[to] += share * largest;
  });
  transport::BlockSparseBuilder builder(transport.layout().count(), std::move(fullScale));
  forRows([&](std::size_t from, std::size_t to, float share) {
    const transport::LeafRow leaves = transport.row(from);
    for (std::size_t entry = 0; entry < leaves.size(); ++entry)
      builder.add(to, leaves.column(entry), share * leaves.block(entry));
  });
  return {small, transport.projectors(), builder.build()};
}

}  // namespace relucent::reduction
