// SPDX-License-Identifier: MIT
#include "wizard/preview/content_preview.h"

#include <algorithm>
#include <limits>
#include <span>

#include "output/default_picture.h"
#include "output/drive_pictures.h"
#include "relucent/base/error.h"
#include "relucent/base/stopwatch.h"
#include "relucent/compensation/prediction.h"
#include "relucent/compensation/uncorrectable.h"
#include "relucent/image/colour.h"
#include "relucent/image/metrics.h"
#include "relucent/pipeline/stored_settings.h"

namespace relucent::gui {
namespace {

/// The picture of the settings, or the product's own where that is gone.
std::shared_ptr<const image::Image> contentFor(const pipeline::ContentSettings& settings) {
  if (!settings.picture.empty()) {
    try {
      return std::make_shared<image::Image>(linearContentOf(QString::fromStdString(settings.picture)));
    } catch (const Error&) {
    }
  }
  return std::make_shared<image::Image>(linearContentOf(defaultPicture()));
}

/// Per pixel of the first camera, the brightest light that the projectors give, as a share of the content's
/// white.
std::vector<float> reachOf(const compensation::MeasuredVenue& venue, float white) {
  std::vector<float> reach(venue.transport.cameras().size(0).count());
  for (std::size_t i = 0; i < reach.size(); ++i) {
    float brightest = std::numeric_limits<float>::infinity();
    for (std::size_t c = 0; c < 3; ++c)
      brightest = std::min(brightest, venue.flood[3 * i + c] + venue.black[3 * i + c]);
    reach[i] = brightest / white;
  }
  return reach;
}

/// As a viewer adapted to the content's white sees it; NaN where no content is.
double ssimOf(const compensation::Prediction& prediction, const compensation::Target& target,
              const Rasters& cameras) {
  std::span<const std::uint8_t> inside(target.inside.data(), cameras.size(0).count());
  if (std::none_of(inside.begin(), inside.end(), [](std::uint8_t in) { return in != 0; }))
    return std::numeric_limits<double>::quiet_NaN();
  return ssim(image::viewed(image::imageFromStack(prediction.camera, cameras, 0), target.white),
              image::viewed(image::imageFromStack(target.wanted, cameras, 0), target.white), inside);
}

/// What of the content no method can correct, and why.
void findUncorrectable(const compensation::MeasuredVenue& venue, const compensation::Target& target,
                       ContentPreview& preview) {
  Progress quiet;
  auto shares = compensation::sharesOf(compensation::uncorrectableMap(venue, target, {}, quiet));
  preview.unlit = shares[static_cast<std::size_t>(compensation::Uncorrectable::unlit)] +
                  shares[static_cast<std::size_t>(compensation::Uncorrectable::shadowed)];
  const compensation::UnreachableShares unreachable = compensation::unreachableShares(venue, target);
  preview.tooDark = unreachable.tooDark;
  preview.tooBright = unreachable.tooBright;
}

}  // namespace

std::shared_ptr<const ContentPreview> previewOf(const PreviewEngine& engine,
                                                const pipeline::ContentSettings& settings,
                                                std::shared_ptr<const image::Image> known) {
  Progress quiet;
  std::shared_ptr<const image::Image> content = known ? std::move(known) : contentFor(settings);
  const compensation::MeasuredVenue& venue = engine.measured.venue;
  const Rasters& cameras = venue.transport.cameras();
  compensation::Target target = fitTarget(*content, venue, targetOf(settings));
  const compensation::Compensation corrected = engine.compensator->solve(settings.method, target, quiet),
                                   warped =
                                       engine.compensator->solve(compensation::Method::none, target, quiet);
  const compensation::Prediction with = compensation::predict(venue, target, corrected),
                                 without = compensation::predict(venue, target, warped);
  auto preview = std::make_shared<ContentPreview>();
  const Rasters& projectors = venue.transport.projectors();
  preview->sentWith = drivePictures(corrected.projector, projectors, engine.encoders);
  preview->sentWithout = drivePictures(warped.projector, projectors, engine.encoders);
  preview->content = content;
  preview->picture = settings.picture;
  preview->with = image::imageFromStack(with.camera, cameras, 0);
  preview->without = image::imageFromStack(without.camera, cameras, 0);
  preview->deltaE = with.deltaE;
  preview->white = target.white[0];
  preview->corners = target.corners;
  preview->reachableShare = with.reachable;
  preview->clipped = with.clipped;
  preview->deltaEMean = with.meanDeltaE;
  preview->psnr = with.psnrReachable;
  preview->reach = reachOf(venue, preview->white);
  auto pixels = static_cast<std::ptrdiff_t>(cameras.size(0).count());
  preview->inside.assign(target.inside.begin(), target.inside.begin() + pixels);
  preview->reachable.assign(target.reachable.begin(), target.reachable.begin() + pixels);
  findUncorrectable(venue, target, *preview);
  return preview;
}

MethodPreview methodPreviewOf(const PreviewEngine& engine, const pipeline::ContentSettings& settings,
                              const image::Image& content, compensation::Method method) {
  Progress quiet;
  const compensation::MeasuredVenue& venue = engine.measured.venue;
  compensation::Target target = fitTarget(content, venue, targetOf(settings));
  engine.compensator->solve(compensation::Method::none, target, quiet);
  Stopwatch watch;
  compensation::Compensation compensation = engine.compensator->solve(method, target, quiet);
  double seconds = watch.seconds();
  compensation::Prediction prediction = compensation::predict(venue, target, compensation);
  return {method, prediction.psnrReachable, ssimOf(prediction, target, venue.transport.cameras()),
          prediction.meanDeltaE, seconds};
}

}  // namespace relucent::gui
