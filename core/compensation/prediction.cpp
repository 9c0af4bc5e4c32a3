// SPDX-License-Identifier: MIT
#include "relucent/compensation/prediction.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "relucent/base/error.h"
#include "relucent/base/parallel.h"
#include "relucent/image/colour.h"
#include "relucent/image/metrics.h"

namespace relucent::compensation {

Prediction compared(CameraStack camera, const Target& target, const Rasters& cameras) {
  require(target.wanted.size() == 3 * cameras.count() && target.inside.size() == cameras.count() &&
              camera.size() == target.wanted.size(),
          "a target of {} and a picture of {} values for {} camera pixels", target.wanted.size(),
          camera.size(), cameras.count());
  Prediction prediction;
  prediction.camera = std::move(camera);

  std::size_t pixels = cameras.size(0).count();
  std::span<const std::uint8_t> inside(target.inside.data(), pixels),
      reachable(target.reachable.data(), pixels);
  image::Image seen = image::imageFromStack(prediction.camera, cameras, 0),
               wanted = image::imageFromStack(target.wanted, cameras, 0);
  prediction.deltaE =
      image::deltaEMap(image::viewed(seen, target.white), image::viewed(wanted, target.white), inside);
  auto covered =
      static_cast<double>(pixels) - static_cast<double>(std::count(inside.begin(), inside.end(), 0));
  double sum = 0.0;
  for (float value : prediction.deltaE.data())
    if (!std::isnan(value)) sum += static_cast<double>(value);
  prediction.meanDeltaE = covered > 0.0 ? sum / covered : 0.0;

  double reached =
      static_cast<double>(pixels) - static_cast<double>(std::count(reachable.begin(), reachable.end(), 0));
  prediction.reachable = covered > 0.0 ? reached / covered : 0.0;
  prediction.psnrReachable =
      reached > 0.0 ? psnr(seen, wanted, target.white, reachable) : std::numeric_limits<double>::quiet_NaN();
  return prediction;
}

Prediction predict(const MeasuredVenue& venue, const Target& target, const Compensation& compensation) {
  CameraStack camera = venue.transport.apply(compensation.projector);
  parallelFor(0, camera.size(), 4096, [&](std::size_t i) { camera[i] += venue.black[i]; });
  Prediction prediction = compared(std::move(camera), target, venue.transport.cameras());
  prediction.clipped = compensation.clipped;
  return prediction;
}

}  // namespace relucent::compensation
