// SPDX-License-Identifier: MIT
#include "relucent/pipeline/outlook.h"

#include <algorithm>
#include <cmath>

#include "relucent/compensation/methods.h"
#include "relucent/compensation/prediction.h"
#include "relucent/image/colour.h"
#include "relucent/pipeline/expected_transport.h"
#include "relucent/pipeline/measured_venue.h"
#include "relucent/pipeline/standard_images.h"
#include "relucent/transport/coarsening.h"

namespace relucent::pipeline {
namespace {

/// Drawn once: it takes a second.
const std::vector<NamedImage>& pictures() {
  static const std::vector<NamedImage> drawn = standardImages();
  return drawn;
}

bool holdsPicture(const compensation::MeasuredVenue& venue) {
  Size content = pictures().front().linear.size();
  return compensation::largestUpright(placeable(venue), venue.transport.cameras().size(0),
                                      static_cast<double>(content.width) / content.height)
      .has_value();
}

/// Mean of |T p|^2 / white^2 over the reachable pixels: what an error of T is relative to.
double lightOf(const compensation::Prediction& seen, const compensation::Target& target,
               const compensation::MeasuredVenue& venue) {
  double sum = 0.0, values = 0.0;
  for (std::size_t i = 0; i < seen.camera.size(); ++i) {
    if (!target.reachable[i / 3]) continue;
    double light =
        static_cast<double>(seen.camera[i] - venue.black[i]) / static_cast<double>(target.white[i % 3]);
    sum += light * light;
    values += 1.0;
  }
  return values > 0.0 ? sum / values : 0.0;
}

/// What a venue shows of the standard images.
struct Shown {
  double psnr = 0.0;  // dB, mean
  image::Image first;
};

Shown shownIn(const compensation::MeasuredVenue& venue, double error, Progress& progress) {
  const inverse::WindowInverse windows = inverse::computeWindows(venue.transport, venue.usable, {}, progress);
  const compensation::Compensator compensator(venue, windows);
  Shown shown;
  for (const NamedImage& picture : pictures()) {
    const compensation::Target target = fitTarget(picture.linear, venue, {});
    const compensation::Compensation compensation =
        compensator.solve(compensation::Method::refined, target, progress);
    const compensation::Prediction seen = predict(venue, target, compensation);
    double off = std::pow(10.0, -0.1 * seen.psnrReachable) + error * error * lightOf(seen, target, venue);
    shown.psnr -= 10.0 * std::log10(off) / static_cast<double>(pictures().size());
    if (shown.first.empty())
      shown.first =
          image::viewed(image::imageFromStack(seen.camera, venue.transport.cameras(), 0), target.white);
  }
  return shown;
}

}  // namespace

std::optional<Outlook> outlookOf(const transport::Draft& draft, Progress& progress) {
  compensation::MeasuredVenue venue = measuredVenueOf(draft.acquisition, {});
  if (!holdsPicture(venue)) return std::nullopt;
  Outlook outlook;
  outlook.blocks = 1 << draft.level;
  Shown now = shownIn(venue, draft.error, progress);
  outlook.picture = std::move(now.first);
  outlook.now = now.psnr;
  if (draft.level > 0 && draft.coarsening > 0) {
    const transport::Acquisition coarse = coarsened(draft.acquisition, {0, 0, draft.level});
    outlook.now = shownIn(measuredVenueOf(coarse, {}), draft.error, progress).psnr;
  }
  outlook.whole = outlook.now;
  if (draft.level > 0) {
    venue.transport = expectedTransport(venue.transport, venue.usable);
    outlook.whole = std::max(outlook.now, shownIn(venue, draft.aim, progress).psnr);
  }
  if (!std::isfinite(outlook.now) || !std::isfinite(outlook.whole)) return std::nullopt;
  return outlook;
}

}  // namespace relucent::pipeline
