// SPDX-License-Identifier: MIT
#include "wizard/preview/content_preview.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "output/default_picture.h"
#include "output/drive_pictures.h"
#include "relucent/base/error.h"
#include "relucent/base/stopwatch.h"
#include "relucent/compensation/expected_error.h"
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
    } catch (const Error&) {  // the list of pictures tells that it is gone
    }
  }
  return std::make_shared<image::Image>(linearContentOf(defaultPicture()));
}

/// Of white over the content's pixels, in all views: the geometric mean of its gains.
float meanGain(const compensation::Target& target) {
  double octaves = 0.0, pixels = 0.0;
  for (std::size_t i = 0; i < target.gain.size(); ++i) {
    if (!target.inside[i]) continue;
    octaves += std::log2(static_cast<double>(target.gain[i]));
    pixels += 1.0;
  }
  return pixels > 0.0 ? static_cast<float>(std::exp2(octaves / pixels)) : 1.0f;
}

/// Per pixel of a camera, the brightest light that the projectors give, as a share of the content's white
/// there.
std::vector<float> reachOf(const compensation::MeasuredVenue& venue, const compensation::Target& target,
                           std::size_t camera) {
  const Rasters& cameras = venue.transport.cameras();
  std::vector<float> reach(cameras.size(camera).count());
  const std::size_t offset = cameras.offset(camera);
  for (std::size_t i = 0; i < reach.size(); ++i) {
    float brightest = std::numeric_limits<float>::infinity();
    for (std::size_t c = 0; c < 3; ++c)
      brightest = std::min(brightest, venue.flood[3 * (offset + i) + c] + venue.black[3 * (offset + i) + c]);
    const float gain = target.gain.empty() ? 1.0f : target.gain[offset + i];
    reach[i] = brightest / (target.white[0] * gain);
  }
  return reach;
}

void addUncertainty(const compensation::ExpectedError& expected, const Rasters& cameras, std::size_t camera,
                    ViewPreview& view) {
  const auto begin = expected.shareOfWhite.begin() + static_cast<std::ptrdiff_t>(cameras.offset(camera));
  view.uncertainty.assign(begin, begin + static_cast<std::ptrdiff_t>(cameras.size(camera).count()));
  view.uncertaintyMean = expected.shareIn(camera, cameras);
}

CameraMask maskOf(const CameraMask& all, const Rasters& cameras, std::size_t camera) {
  const auto begin = all.begin() + static_cast<std::ptrdiff_t>(cameras.offset(camera));
  return {begin, begin + static_cast<std::ptrdiff_t>(cameras.size(camera).count())};
}

/// As a viewer adapted to the content's white sees it; NaN where no content is.
double ssimOf(const CameraStack& seen, const compensation::Target& target, const Rasters& cameras,
              std::size_t camera) {
  std::span<const std::uint8_t> inside(target.inside.data() + cameras.offset(camera),
                                       cameras.size(camera).count());
  if (std::none_of(inside.begin(), inside.end(), [](std::uint8_t in) { return in != 0; }))
    return std::numeric_limits<double>::quiet_NaN();
  return ssim(image::viewed(underEvenWhite(seen, target, cameras, camera), target.white),
              image::viewed(underEvenWhite(target.wanted, target, cameras, camera), target.white), inside);
}

double weightOf(const compensation::Target& target, std::size_t camera) {
  return camera < target.viewWeight.size() ? static_cast<double>(target.viewWeight[camera]) : 1.0;
}

ViewPreview viewOf(std::size_t camera, const compensation::MeasuredVenue& venue,
                   const compensation::Target& target, const CameraStack& without, const CameraStack& with) {
  const Rasters& cameras = venue.transport.cameras();
  ViewPreview view;
  compensation::ViewError error = compensation::errorIn(camera, with, target, cameras);
  view.with = image::imageFromStack(with, cameras, camera);
  view.without = image::imageFromStack(without, cameras, camera);
  view.deltaE = std::move(error.deltaE);
  view.reach = reachOf(venue, target, camera);
  view.inside = maskOf(target.inside, cameras, camera);
  view.reachable = maskOf(target.reachable, cameras, camera);
  view.reachableShare = error.reachable;
  view.deltaEMean = error.meanDeltaE;
  view.psnr = error.psnrReachable;
  view.weight = weightOf(target, camera);
  if (camera == 0)
    view.corners = target.corners;
  else if (camera < target.placements.size() && target.placements[camera])
    view.corners = target.placements[camera]->corners;
  return view;
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
  const compensation::ExpectedError expected =
      expectedError(venue, engine.measured.acquisition.variance, target, corrected.projector);
  for (std::size_t camera = 0; camera < cameras.devices(); ++camera) {
    preview->views.push_back(viewOf(camera, venue, target, without.camera, with.camera));
    if (expected.isKnown()) addUncertainty(expected, cameras, camera, preview->views.back());
  }
  preview->white = target.white[0] * meanGain(target);
  preview->blackLift = target.blackLift;
  preview->corners = target.corners;
  preview->reachableShare = with.reachable;
  preview->clipped = with.clipped;
  preview->deltaEMean = with.meanDeltaE;
  preview->psnr = with.psnrReachable;
  findUncorrectable(venue, target, *preview);
  preview->corrected = corrected;
  return preview;
}

std::shared_ptr<const compensation::Contradiction> contradictionIn(const PreviewEngine& engine,
                                                                   const pipeline::ContentSettings& settings,
                                                                   const ContentPreview& preview) {
  Progress quiet;
  const compensation::Target target = fitTarget(*preview.content, engine.measured.venue, targetOf(settings));
  return std::make_shared<compensation::Contradiction>(
      contradictionOf(*engine.compensator, target, preview.corrected, quiet));
}

MethodPreview methodPreviewOf(const PreviewEngine& engine, const pipeline::ContentSettings& settings,
                              const image::Image& content, compensation::Method method) {
  Progress quiet;
  const compensation::MeasuredVenue& venue = engine.measured.venue;
  const Rasters& cameras = venue.transport.cameras();
  compensation::Target target = fitTarget(content, venue, targetOf(settings));
  engine.compensator->solve(compensation::Method::none, target, quiet);
  Stopwatch watch;
  compensation::Compensation compensation = engine.compensator->solve(method, target, quiet);
  MethodPreview preview{method};
  preview.seconds = watch.seconds();
  const CameraStack seen = compensation::predict(venue, target, compensation).camera;
  int views = 0;
  for (std::size_t camera = 0; camera < cameras.devices(); ++camera) {
    // Nobody asks for a view without weight, and nothing can be said of one that nothing is wanted in.
    const double similar = ssimOf(seen, target, cameras, camera);
    if (!(weightOf(target, camera) > 0.0) || (cameras.devices() > 1 && std::isnan(similar))) continue;
    const compensation::ViewError error = compensation::errorIn(camera, seen, target, cameras);
    preview.psnr += error.psnrReachable;
    preview.deltaE += error.meanDeltaE;
    preview.ssim += similar;
    ++views;
  }
  if (views > 1) {
    preview.psnr /= views;
    preview.deltaE /= views;
    preview.ssim /= views;
  }
  return preview;
}

}  // namespace relucent::gui
