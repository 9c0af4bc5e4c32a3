// SPDX-License-Identifier: MIT
#include "wizard/preview/content_preview.h"

#include <algorithm>
#include <limits>
#include <span>

#include "base/error.h"
#include "base/stopwatch.h"
#include "compensation/prediction.h"
#include "compensation/uncorrectable.h"
#include "image/colour.h"
#include "image/metrics.h"
#include "output/default_picture.h"
#include "pipeline/stored_settings.h"

namespace relucent {
namespace {

/// The picture of the settings, or the product's own where that is gone.
std::shared_ptr<const Image> contentFor(const ContentSettings& settings) {
  if (!settings.picture.empty()) {
    try {
      return std::make_shared<Image>(linearContentOf(QString::fromStdString(settings.picture)));
    } catch (const Error&) {
    }
  }
  return std::make_shared<Image>(linearContentOf(defaultPicture()));
}

/// Per pixel of the first camera, the brightest light that the projectors give, as a share of the content's
/// white.
std::vector<float> reachOf(const MeasuredVenue& venue, float white) {
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
double ssimOf(const Prediction& prediction, const Target& target, const Rasters& cameras) {
  std::span<const std::uint8_t> inside(target.inside.data(), cameras.size(0).count());
  if (std::none_of(inside.begin(), inside.end(), [](std::uint8_t in) { return in != 0; }))
    return std::numeric_limits<double>::quiet_NaN();
  return ssim(viewed(imageFromStack(prediction.camera, cameras, 0), target.white),
              viewed(imageFromStack(target.wanted, cameras, 0), target.white), inside);
}

/// What of the content no method can correct, and why.
void findUncorrectable(const MeasuredVenue& venue, const Target& target, ContentPreview& preview) {
  Progress quiet;
  auto shares = sharesOf(uncorrectableMap(venue, target, {}, quiet));
  preview.unlit = shares[static_cast<std::size_t>(Uncorrectable::unlit)] +
                  shares[static_cast<std::size_t>(Uncorrectable::shadowed)];
  preview.tooDark = shares[static_cast<std::size_t>(Uncorrectable::tooDark)] + preview.unlit;
  preview.tooBright = shares[static_cast<std::size_t>(Uncorrectable::tooBright)];
}

}  // namespace

std::shared_ptr<const ContentPreview> previewOf(const PreviewEngine& engine, const ContentSettings& settings,
                                                std::shared_ptr<const Image> known) {
  Progress quiet;
  std::shared_ptr<const Image> content = known ? std::move(known) : contentFor(settings);
  const MeasuredVenue& venue = engine.measured.venue;
  const Rasters& cameras = venue.transport.cameras();
  Target target = fitTarget(*content, venue, targetOf(settings));
  Prediction with = predict(venue, target, engine.compensator->solve(settings.method, target, quiet));
  Prediction without = predict(venue, target, engine.compensator->solve(Method::none, target, quiet));
  auto preview = std::make_shared<ContentPreview>();
  preview->content = content;
  preview->picture = settings.picture;
  preview->with = imageFromStack(with.camera, cameras, 0);
  preview->without = imageFromStack(without.camera, cameras, 0);
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

MethodPreview methodPreviewOf(const PreviewEngine& engine, const ContentSettings& settings,
                              const Image& content, Method method) {
  Progress quiet;
  const MeasuredVenue& venue = engine.measured.venue;
  Target target = fitTarget(content, venue, targetOf(settings));
  engine.compensator->solve(Method::none, target, quiet);
  Stopwatch watch;
  Compensation compensation = engine.compensator->solve(method, target, quiet);
  double seconds = watch.seconds();
  Prediction prediction = predict(venue, target, compensation);
  return {method, prediction.psnrReachable, ssimOf(prediction, target, venue.transport.cameras()),
          prediction.meanDeltaE, seconds};
}

}  // namespace relucent
