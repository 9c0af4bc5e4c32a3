// SPDX-License-Identifier: MIT
#include "relucent/pipeline/outlook.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "relucent/compensation/methods.h"
#include "relucent/compensation/prediction.h"
#include "relucent/image/colour.h"
#include "relucent/pipeline/expected_transport.h"
#include "relucent/pipeline/measured_venue.h"
#include "relucent/pipeline/standard_images.h"

namespace relucent::pipeline {
namespace {

bool holdsPicture(const compensation::MeasuredVenue& venue) {
  Size content = standardImages().front().linear.size();
  return compensation::automaticCorners(venue, static_cast<double>(content.width) / content.height)
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

/// Mean variance of a picture within squares, pixels: what blocks of that side hide of it.
double hiddenIn(const image::Image& picture, double side) {
  if (side <= 1.0) return 0.0;
  const auto smaller = [side](int pixels) {
    return std::max(1, static_cast<int>(std::lround(pixels / side)));
  };
  const cv::Mat whole(picture.size().height, picture.size().width, CV_32FC3,
                      const_cast<float*>(picture.data().data()));
  cv::Mat means;
  cv::resize(whole, means, {smaller(whole.cols), smaller(whole.rows)}, 0.0, 0.0, cv::INTER_AREA);
  const auto energy = [](const cv::Mat& of) { return of.dot(of) / (3.0 * static_cast<double>(of.total())); };
  return std::max(0.0, energy(whole) - energy(means));
}

/// Lengths that a coarse draft does not resolve, in pixels of its cameras.
struct Unresolved {
  double blocks = 0.0;  // of T
  double pixel = 1.0;   // of the venue's camera: what it averages nobody sees
};

Unresolved unresolvedBy(const transport::Draft& draft, const compensation::MeasuredVenue& venue) {
  const double lit = static_cast<double>(std::count(venue.usable.begin(), venue.usable.end(), 1));
  const double projector = std::sqrt(lit / static_cast<double>(venue.transport.projectors().count()));
  return {std::min(1.0, projector * std::exp2(draft.level - draft.coarsening)), std::exp2(-draft.coarsening)};
}

/// What a venue shows of the standard images.
struct Shown {
  double psnr = 0.0;  // dB, mean
  image::Image first;
};

Shown shownIn(const compensation::MeasuredVenue& venue, double error, const Unresolved& unresolved,
              Progress& progress) {
  const inverse::WindowInverse windows = inverse::computeWindows(venue.transport, venue.usable, {}, progress);
  const compensation::Compensator compensator(venue, windows);
  Shown shown;
  for (const NamedImage& picture : standardImages()) {
    const compensation::Target target =
        fitTarget(picture.linear, venue, compensation::TargetSettings::ofLight());
    const compensation::Compensation compensation =
        compensator.solve(compensation::Method::refined, target, progress);
    const compensation::Prediction seen = predict(venue, target, compensation);
    double off = std::pow(10.0, -0.1 * seen.psnrReachable) + error * error * lightOf(seen, target, venue);
    const double perPixel =
        picture.linear.size().width / std::max(1.0, target.corners[1][0] - target.corners[0][0]);
    off += std::max(0.0, hiddenIn(picture.linear, unresolved.blocks * perPixel) -
                             hiddenIn(picture.linear, unresolved.pixel * perPixel));
    shown.psnr -= 10.0 * std::log10(off) / static_cast<double>(standardImages().size());
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
  // Blocks hide more than T is off by; of single pixels, at first, no more is known than what is asked for.
  const double error = draft.level == 0 && draft.error == 0.0 ? draft.aim : draft.error;
  Outlook outlook;
  outlook.blocks = 1 << draft.level;
  Shown now = shownIn(venue, error, unresolvedBy(draft, venue), progress);
  outlook.picture = std::move(now.first);
  outlook.now = now.psnr;
  outlook.whole = outlook.now;
  if (draft.level > 0) {
    venue.transport = expectedTransport(venue.transport, venue.usable);
    outlook.whole = std::max(outlook.now, shownIn(venue, draft.aim, {}, progress).psnr);
  }
  if (!std::isfinite(outlook.now) || !std::isfinite(outlook.whole)) return std::nullopt;
  return outlook;
}

}  // namespace relucent::pipeline
