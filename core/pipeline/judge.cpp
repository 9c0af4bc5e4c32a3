// SPDX-License-Identifier: MIT
#include "relucent/pipeline/judge.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "relucent/base/random.h"
#include "relucent/compensation/direct_light.h"
#include "relucent/image/colour.h"
#include "relucent/image/metrics.h"
#include "relucent/pipeline/projection.h"
#include "relucent/pipeline/standard_images.h"
#include "relucent/reduction/reduced_transport.h"
#include "relucent/transport/difference.h"

namespace relucent::pipeline {
namespace {

/// |T p - R p| / |R p|
double relightError(const transport::TransportMatrix& transport, const transport::TransportMatrix& reference,
                    const ProjectorStack& pattern) {
  Stack relit = transport.apply(pattern);
  Stack truth = reference.apply(pattern);
  double apart = 0.0;
  double whole = 0.0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    double difference = static_cast<double>(relit[i]) - truth[i];
    apart += difference * difference;
    whole += static_cast<double>(truth[i]) * truth[i];
  }
  return whole > 0.0 ? std::sqrt(apart / whole) : 0.0;
}

double sumOf(const Stack& stack) {
  return std::accumulate(stack.begin(), stack.end(), 0.0);
}

}  // namespace

TransportScore transportScore(const transport::TransportMatrix& transport, const venue::SimulatedVenue& venue,
                              const std::vector<reduction::Reduction>& reductions) {
  const transport::TransportMatrix reduced =
      reductions.empty() ? transport::TransportMatrix()
                         : reduction::reducedTransport(venue.trueTransport(), reductions);
  const transport::TransportMatrix& truth = reductions.empty() ? venue.trueTransport() : reduced;
  transport::TransportDifference apart = transport::difference(transport, truth);
  ProjectorStack natural(patternFrom(standardImages().front().linear, transport.projectors()));
  ProjectorStack binary(natural.size());
  Random random{20071028, 2};
  for (float& value : binary) value = random.uniform() < 0.5 ? 0.0f : 1.0f;
  return {apart.frobenius,
          apart.rowMedian,
          apart.rowP95,
          relightError(transport, truth, natural),
          relightError(transport, truth, binary),
          sumOf(transport.floodlight()) / sumOf(truth.floodlight())};
}

Judge::Judge(const MeasuredCalibration& measured, const venue::SimulatedVenue& venue,
             std::vector<reduction::Reduction> reductions, Rasters rasters)
    : measured_(measured), venue_(venue), reductions_(std::move(reductions)), rasters_(std::move(rasters)) {
  black_ = reduction::reducedRadiance(venue.trueBlack(), reductions_);
  brightest_ = brightestOf(ProjectorStack(measured.venue.transport.projectors().count() * 3, 1.0f));
}

CameraMask Judge::roomy(const compensation::Target& target, float share) const {
  CameraStack light = black_;
  for (std::size_t i = 0; i < light.size(); ++i) light[i] += share * (brightest_[i] - black_[i]);
  return within(target, light);
}

CameraMask Judge::reachableAlone(const compensation::Target& target, std::size_t projector) const {
  const Rasters& projectors = measured_.venue.transport.projectors();
  ProjectorStack white(projectors.count() * 3, 0.0f);
  const auto first = white.begin() + 3 * static_cast<std::ptrdiff_t>(projectors.offset(projector));
  std::fill_n(first, 3 * projectors.size(projector).count(), 1.0f);
  return within(target, brightestOf(white));
}

CameraStack Judge::seen(const compensation::Compensation& compensation) const {
  std::vector<image::Image> drive =
      encodedDrive(compensation.projector, measured_.venue.transport.projectors(), measured_.linearization);
  return reduction::reducedRadiance(venue_.trueRadiance(drive), reductions_);
}

CameraStack Judge::direct(const compensation::Compensation& compensation, Progress& progress) const {
  const transport::TransportMatrix& truth = venue_.trueTransport();
  return reduction::reducedRadiance(
      relucent::compensation::directPart(truth, {}, progress).apply(compensation.projector), reductions_);
}

image::Image Judge::view(const CameraStack& stack, std::size_t camera) const {
  return image::imageFromStack(stack, rasters_, camera);
}

CameraMask Judge::view(const CameraMask& mask, std::size_t camera) const {
  const auto begin = mask.begin() + static_cast<std::ptrdiff_t>(rasters_.offset(camera));
  return {begin, begin + static_cast<std::ptrdiff_t>(rasters_.size(camera).count())};
}

std::optional<MethodScore> Judge::scoreOf(compensation::Method method, const CameraStack& seen,
                                          const compensation::Target& target, const CameraMask& reachable,
                                          std::size_t camera) const {
  if (std::ranges::count(view(target.inside, camera), 0) == std::ssize(view(target.inside, camera)))
    return std::nullopt;
  return score(method, seen, target, reachable, camera);
}

CameraStack Judge::brightestOf(const ProjectorStack& white) const {
  CameraStack brightest = reduction::reducedRadiance(venue_.trueTransport().apply(white), reductions_);
  for (std::size_t i = 0; i < brightest.size(); ++i) brightest[i] += black_[i];
  return brightest;
}

CameraMask Judge::within(const compensation::Target& target, const CameraStack& brightest) const {
  CameraMask reachable = target.inside;
  for (std::size_t i = 0; i < target.wanted.size(); ++i)
    if (target.wanted[i] < black_[i] || target.wanted[i] > brightest[i]) reachable[i / 3] = 0;
  return reachable;
}

/// Where nothing is reachable there is no such error: NaN.  Contract: the content covers some of it.
MethodScore Judge::score(compensation::Method method, const CameraStack& seen,
                         const compensation::Target& target, const CameraMask& reachable,
                         std::size_t camera) const {
  const CameraMask inside = view(target.inside, camera), mask = view(reachable, camera);
  const image::Image wanted = underEvenWhite(target.wanted, target, rasters_, camera),
                     is = underEvenWhite(seen, target, rasters_, camera);

  MethodScore result;
  result.method = method;
  result.psnrAll = psnr(is, wanted, target.white, inside);
  const image::Image seenEncoded = image::viewed(is, target.white);
  const image::Image wantedEncoded = image::viewed(wanted, target.white);
  result.encodedPsnrAll = psnr(seenEncoded, wantedEncoded, 1.0, inside);
  result.ssim = ssim(seenEncoded, wantedEncoded, inside);
  result.multiScaleSsim = multiScaleSsim(seenEncoded, wantedEncoded, inside);
  const image::ColourDifference colour = colourDifference(seenEncoded, wantedEncoded, inside);
  result.deltaE = colour.mean;
  result.deltaEPercentile = colour.percentile95;
  if (std::ranges::count(mask, 0) == std::ssize(mask)) {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    result.psnrReachable = result.encodedPsnrReachable = result.deltaEReachable = none;
    return result;
  }
  result.psnrReachable = psnr(is, wanted, target.white, mask);
  result.encodedPsnrReachable = psnr(seenEncoded, wantedEncoded, 1.0, mask);
  result.deltaEReachable = meanDeltaE(seenEncoded, wantedEncoded, mask);
  return result;
}

std::optional<UnseenPlaces> UnseenPlaces::of(const MeasuredCalibration& measured,
                                             const venue::SimulatedVenue& venue, Progress& progress) {
  std::optional<venue::SimulatedVenue> places = venue.fromHiddenPlaces(progress);
  if (!places) return std::nullopt;
  return UnseenPlaces(measured, *std::move(places));
}

compensation::Target UnseenPlaces::target(const compensation::Target& seen) const {
  const Size view = measured_->venue.transport.cameras().size(0);
  const CameraMask inside(seen.inside.begin(),
                          seen.inside.begin() + static_cast<std::ptrdiff_t>(view.count()));
  compensation::Target unseen;
  unseen.white = seen.white;
  unseen.wanted = judge_->black();
  unseen.inside.assign(map_.size(), 0);
  if (!seen.gain.empty()) unseen.gain.assign(map_.size(), 1.0f);
  for (std::size_t i = 0; i < map_.size(); ++i) {
    const std::optional<compensation::ViewSample> sample = compensation::sampleAt(map_[i], view, inside);
    if (!sample) continue;
    unseen.inside[i] = 1;
    if (!seen.gain.empty()) {
      unseen.gain[i] = 0.0f;
      for (std::size_t k = 0; k < sample->pixel.size(); ++k)
        unseen.gain[i] += sample->share[k] * seen.gain[sample->pixel[k]];
    }
    for (std::size_t c = 0; c < 3; ++c) {
      float& wanted = unseen.wanted[3 * i + c] = 0.0f;
      for (std::size_t k = 0; k < sample->pixel.size(); ++k)
        wanted += sample->share[k] * seen.wanted[3 * sample->pixel[k] + c];
    }
  }
  return unseen;
}

UnseenPlaces::UnseenPlaces(const MeasuredCalibration& measured, const venue::SimulatedVenue& places)
    : measured_(&measured), places_(std::make_unique<venue::SimulatedVenue>(places)) {
  const transport::TransportMatrix& truth = places_->trueTransport();
  judge_.emplace(measured, *places_, std::vector<reduction::Reduction>(), truth.cameras());
  // As a measurement would have it that is without noise.
  transport::Acquisition exact;
  exact.flood = truth.floodlight();
  exact.floodVariance.assign(exact.flood.size(), 0.0f);
  exact.flagged.assign(truth.cameras().count(), 0);
  Progress quiet;
  compensation::MeasuredVenue seen;
  seen.usable = usablePixels(exact);
  seen.direct = compensation::directlyLit(compensation::directLooks(truth, {}, quiet));
  map_ = compensation::viewMapInto(measured.venue.transport, seesProjection(measured.venue),
                                   measured.venue.views, truth, seesProjection(seen));
}

}  // namespace relucent::pipeline
