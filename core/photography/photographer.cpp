// SPDX-License-Identifier: MIT
#include "relucent/photography/photographer.h"

#include <algorithm>
#include <cmath>

#include "relucent/base/error.h"
#include "relucent/base/parallel.h"

namespace relucent::photography {
namespace {

// Expected radiances come from noisy measurements: stay this far below saturation. What saturates all the
// same is taken again, so the margin costs shots, not correctness.
constexpr double saturationMargin = 0.9;
// An exposure is as good as a pixel's best while its noise is at most this much larger, ...
constexpr double tolerableLoss = 2.0;
// ... and one more is taken for at least this share of the pixels that are needed.
constexpr double worthAnExposure = 0.02;
constexpr int previewWidth = 320;

Preview previewOf(const rig::Shot& shot) {
  // The shortest exposure: the one that a person would call well exposed.
  const image::Image& photograph = shot.frames.back().front().signal;
  int step = std::max(1, (photograph.width() + previewWidth - 1) / previewWidth);
  Preview preview{"photograph", {photograph.width() / step, photograph.height() / step}, {}};
  preview.rgb.reserve(3 * preview.size.count());
  for (int y = 0; y < preview.size.height; ++y)
    for (int x = 0; x < preview.size.width; ++x)
      for (int c = 0; c < 3; ++c) preview.rgb.push_back(photograph.at(x * step, y * step, c));
  return preview;
}

}  // namespace

Photographer::Photographer(rig::ShotTaker& shots, const linearization::Linearization& linearization)
    : shots_(shots),
      linearization_(linearization),
      cameras_(shots.rig().cameraRasters()),
      projectors_(shots.rig().projectorRasters()) {
  require(linearization.cameras.size() == cameras_.devices(), "{} camera models for {} cameras",
          linearization.cameras.size(), cameras_.devices());
  require(!linearization.exposures.empty() &&
              std::is_sorted(linearization.exposures.rbegin(), linearization.exposures.rend()),
          "{} exposures, longest first", linearization.exposures.size());
  for (std::size_t camera = 0; camera < cameras_.devices(); ++camera) {
    cameraOf_.insert(cameraOf_.end(), cameras_.size(camera).count(), static_cast<std::uint8_t>(camera));
    const hdr::CameraModel& model = linearization.cameras[camera];
    double lowest = 1.0;
    for (const hdr::ResponseCurve& response : model.response)
      lowest = std::min(lowest, response(model.saturation));
    saturation_.push_back(lowest);
  }
}

double Photographer::deviation(std::size_t row, double radiance, std::size_t exposure) const {
  const hdr::CameraModel& model = linearization_.cameras[cameraOf_[row]];
  double seconds = hdr::trueSeconds(model, linearization_.exposures[exposure]);
  return std::sqrt(hdr::linearVariance(model, radiance * seconds)) / seconds;
}

std::size_t Photographer::longestUnsaturated(std::size_t row, double radiance) const {
  const std::vector<double>& exposures = linearization_.exposures;
  std::size_t exposure = 0;
  double limit = saturationMargin * saturation_[cameraOf_[row]];
  while (exposure + 1 < exposures.size() && radiance * exposures[exposure] >= limit) ++exposure;
  return exposure;
}

std::vector<std::size_t> Photographer::exposuresFor(const std::vector<Demand>& demands) const {
  // How many pixels can live with the exposures from the longest that does not saturate them to the
  // shortest that is not too noisy for them.
  std::size_t count = linearization_.exposures.size();
  std::vector<std::vector<std::size_t>> parts(fixedParts, std::vector<std::size_t>(count * count, 0));
  parallelChunks(0, demands.size(), fixedParts, [&](std::size_t part, std::size_t begin, std::size_t end) {
    for (std::size_t row = begin; row < end; ++row) {
      const Demand& demand = demands[row];
      if (demand.brightest < 0.0f) continue;
      std::size_t longest = longestUnsaturated(row, static_cast<double>(demand.brightest));
      auto expected = static_cast<double>(demand.expected);
      double enough =
          std::max(static_cast<double>(demand.deviation), tolerableLoss * deviation(row, expected, longest));
      std::size_t shortest = longest;
      while (shortest + 1 < count && deviation(row, expected, shortest + 1) <= enough) ++shortest;
      ++parts[part][longest * count + shortest];
    }
  });
  std::vector<std::size_t> pixels(count * count, 0);
  std::size_t all = 0, shortestNeeded = 0;
  for (const std::vector<std::size_t>& part : parts)
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      pixels[i] += part[i];
      all += part[i];
      if (part[i] > 0) shortestNeeded = std::max(shortestNeeded, i / count);
    }
  if (all == 0) return {};

  // Saturation is no choice: the brightest pixel decides the shortest exposure. Longer ones follow while
  // they save many pixels from noise.
  std::vector<std::size_t> chosen{shortestNeeded};
  while (true) {
    std::vector<std::size_t> served(count, 0);
    for (std::size_t longest = 0; longest < count; ++longest) {
      for (std::size_t shortest = longest; shortest < count; ++shortest) {
        bool done = std::any_of(chosen.begin(), chosen.end(), [&](std::size_t exposure) {
          return longest <= exposure && exposure <= shortest;
        });
        if (done) continue;
        for (std::size_t exposure = longest; exposure <= shortest; ++exposure)
          served[exposure] += pixels[longest * count + shortest];
      }
    }
    auto best = std::max_element(served.begin(), served.end());
    if (static_cast<double>(*best) <= worthAnExposure * static_cast<double>(all)) break;
    chosen.push_back(static_cast<std::size_t>(best - served.begin()));
  }
  std::sort(chosen.begin(), chosen.end());
  return chosen;
}

rig::Shot Photographer::shoot(const std::vector<image::Image>& encoded,
                              const std::vector<std::size_t>& exposures, const Progress& progress,
                              const Meanwhile& meanwhile) {
  std::vector<double> seconds;
  for (std::size_t exposure : exposures) seconds.push_back(linearization_.exposures[exposure]);
  rig::Shot shot = runWithBackground(meanwhile, [&] { return shots_.take(encoded, seconds, progress); });
  progress.preview(previewOf(shot));
  return shot;
}

bool Photographer::needsShorter(const hdr::HdrFrame& frame, const std::vector<Demand>& demands) const {
  for (std::size_t row = 0; row < demands.size(); ++row)
    if (demands[row].brightest >= 0.0f &&
        !(frame.valid[3 * row] && frame.valid[3 * row + 1] && frame.valid[3 * row + 2]))
      return true;
  return false;
}

void Photographer::compareExposures(const rig::Shot& shot) {
  contradiction_ = bracketContradiction(shot, linearization_.cameras);
  contradictory_.reset();
  if (contradiction_ >= worthALook)
    contradictory_ = photography::contradictoryViews(shot, linearization_.cameras);
}

hdr::HdrFrame Photographer::take(const ProjectorStack& pattern, const std::vector<Demand>& demands,
                                 const Progress& progress, const Meanwhile& meanwhile) {
  require(demands.size() == cameras_.count(), "{} demands for {} camera pixels", demands.size(),
          cameras_.count());
  std::vector<std::size_t> exposures = exposuresFor(demands);
  require(!exposures.empty(), "no camera pixel needs this photograph");

  std::vector<image::Image> encoded;
  for (std::size_t projector = 0; projector < projectors_.devices(); ++projector)
    encoded.push_back(image::imageFromStack(pattern, projectors_, projector));
  rig::Shot shot = shoot(encoded, exposures, progress, meanwhile);
  hdr::HdrFrame frame = hdr::mergeBracket(shot, linearization_.cameras, cameras_);
  overexposed_ = 0;

  for (std::size_t shorter = exposures.back() + 1; shorter < linearization_.exposures.size(); ++shorter) {
    if (!needsShorter(frame, demands)) break;
    ++overexposed_;
    rig::Shot again = shoot(encoded, {shorter}, progress, {});
    shot.frames.push_back(std::move(again.frames.front()));
    frame = hdr::mergeBracket(shot, linearization_.cameras, cameras_);
  }
  compareExposures(shot);
  return frame;
}

hdr::HdrFrame Photographer::takeAll(const ProjectorStack& pattern, const Progress& progress,
                                    const Meanwhile& meanwhile) {
  std::vector<std::size_t> all(linearization_.exposures.size());
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
  return takeAt(pattern, all, progress, meanwhile);
}

hdr::HdrFrame Photographer::takeAt(const ProjectorStack& pattern, const std::vector<std::size_t>& exposures,
                                   const Progress& progress, const Meanwhile& meanwhile) {
  std::vector<image::Image> encoded;
  for (std::size_t projector = 0; projector < projectors_.devices(); ++projector)
    encoded.push_back(image::imageFromStack(pattern, projectors_, projector));
  rig::Shot shot = shoot(encoded, exposures, progress, meanwhile);
  compareExposures(shot);
  return hdr::mergeBracket(shot, linearization_.cameras, cameras_);
}

}  // namespace relucent::photography
