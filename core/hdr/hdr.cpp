// SPDX-License-Identifier: MIT
#include "relucent/hdr/hdr.h"

#include <algorithm>
#include <cmath>

#include "relucent/base/error.h"
#include "relucent/base/parallel.h"

namespace relucent::hdr {

double trueSeconds(const CameraModel& camera, double reported) {
  const std::vector<ExposureTime>& times = camera.times;
  if (times.empty()) return reported;
  auto after = std::lower_bound(times.begin(), times.end(), reported,
                                [](const ExposureTime& time, double value) { return time.reported < value; });
  if (after == times.begin()) return reported * after->scale;
  auto before = after - 1;
  if (after == times.end()) return reported * before->scale;
  double share = std::log(reported / before->reported) / std::log(after->reported / before->reported);
  return reported * (before->scale + share * (after->scale - before->scale));
}

HdrFrame meanOf(const std::vector<HdrFrame>& frames) {
  require(!frames.empty(), "no frames to take the mean of");
  std::size_t values = frames.front().radiance.size();
  for (const HdrFrame& frame : frames)
    require(
        frame.radiance.size() == values && frame.variance.size() == values && frame.valid.size() == values,
        "frames of {} and {} values", values, frame.radiance.size());
  HdrFrame mean = frames.front();
  parallelFor(0, values, 4096, [&](std::size_t at) {
    double radiance = 0.0, variance = 0.0;
    int count = 0;
    for (const HdrFrame& frame : frames) {
      if (frame.valid[at] == 0) {
        if (mean.valid[at] == 0 && frame.radiance[at] > mean.radiance[at]) {
          mean.radiance[at] = frame.radiance[at];
          mean.variance[at] = frame.variance[at];
        }
        continue;
      }
      radiance += frame.radiance[at];
      variance += frame.variance[at];
      ++count;
    }
    if (count == 0) return;
    mean.radiance[at] = static_cast<float>(radiance / count);
    mean.variance[at] = static_cast<float>(variance / count / count);
    mean.valid[at] = 1;
  });
  return mean;
}

ProjectedLight::ProjectedLight(HdrFrame frame, const BlackLevel& black) : HdrFrame(std::move(frame)) {
  parallelFor(0, radiance.size(), 4096, [&](std::size_t i) {
    radiance[i] -= black.radiance[i];
    variance[i] += black.variance[i];
    valid[i] = valid[i] != 0 && black.valid[i] != 0 ? 1 : 0;
  });
}

LampLight::LampLight(ProjectedLight light, double power) : HdrFrame(std::move(light)) {
  auto scale = static_cast<float>(1.0 / power);
  parallelFor(0, radiance.size(), 4096, [&](std::size_t i) {
    radiance[i] *= scale;
    variance[i] *= scale * scale;
  });
}

}  // namespace relucent::hdr
