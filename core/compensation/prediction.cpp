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

ViewError errorIn(std::size_t camera, const CameraStack& camerasSee, const Target& target,
                  const Rasters& cameras) {
  require(target.wanted.size() == 3 * cameras.count() && target.inside.size() == cameras.count() &&
              camerasSee.size() == target.wanted.size(),
          "a target of {} and a picture of {} values for {} camera pixels", target.wanted.size(),
          camerasSee.size(), cameras.count());
  ViewError error;
  std::size_t pixels = cameras.size(camera).count(), offset = cameras.offset(camera);
  std::span<const std::uint8_t> inside(target.inside.data() + offset, pixels),
      reachable(target.reachable.data() + offset, pixels);
  image::Image seen = underEvenWhite(camerasSee, target, cameras, camera),
               wanted = underEvenWhite(target.wanted, target, cameras, camera);
  error.deltaE =
      image::deltaEMap(image::viewed(seen, target.white), image::viewed(wanted, target.white), inside);
  auto covered =
      static_cast<double>(pixels) - static_cast<double>(std::count(inside.begin(), inside.end(), 0));
  double sum = 0.0;
  for (float value : error.deltaE.data())
    if (!std::isnan(value)) sum += static_cast<double>(value);
  error.meanDeltaE = covered > 0.0 ? sum / covered : 0.0;

  double reached =
      static_cast<double>(pixels) - static_cast<double>(std::count(reachable.begin(), reachable.end(), 0));
  error.reachable = covered > 0.0 ? reached / covered : 0.0;
  error.psnrReachable =
      reached > 0.0 ? psnr(seen, wanted, target.white, reachable) : std::numeric_limits<double>::quiet_NaN();
  return error;
}

Prediction compared(CameraStack camera, const Target& target, const Rasters& cameras) {
  Prediction prediction;
  ViewError first = errorIn(0, camera, target, cameras);
  prediction.camera = std::move(camera);
  prediction.deltaE = std::move(first.deltaE);
  prediction.meanDeltaE = first.meanDeltaE;
  prediction.psnrReachable = first.psnrReachable;
  prediction.reachable = first.reachable;
  return prediction;
}

Prediction predict(const MeasuredVenue& venue, const Target& target, const Compensation& compensation) {
  const transport::TransportMatrix& transport = venue.uncut ? *venue.uncut : venue.transport;
  CameraStack camera = transport.apply(compensation.projector);
  parallelFor(0, camera.size(), 4096, [&](std::size_t i) { camera[i] += venue.black[i]; });
  Prediction prediction = compared(std::move(camera), target, venue.transport.cameras());
  prediction.clipped = compensation.clipped;
  return prediction;
}

}  // namespace relucent::compensation
