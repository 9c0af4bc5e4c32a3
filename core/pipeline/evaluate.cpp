// SPDX-License-Identifier: MIT
#include "relucent/pipeline/evaluate.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "relucent/base/error.h"
#include "relucent/base/random.h"
#include "relucent/base/stopwatch.h"
#include "relucent/image/colour.h"
#include "relucent/image/metrics.h"
#include "relucent/image/picture_files.h"
#include "relucent/pipeline/devices.h"
#include "relucent/pipeline/evaluation.h"
#include "relucent/pipeline/projection.h"
#include "relucent/pipeline/standard_images.h"
#include "relucent/reduction/reduced_transport.h"
#include "relucent/transport/difference.h"

// The only place that asks a simulated venue for its true light transport.
namespace relucent::pipeline {
namespace fs = std::filesystem;
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

TransportScore scoreOf(const transport::TransportMatrix& transport, const venue::SimulatedVenue& venue,
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

OpenedRig openedVenue(const MeasuredCalibration& measured, const fs::path& cache, Progress& progress) {
  if (!std::holds_alternative<venue::VenueSettings>(measured.rig))
    throw Error(ErrorKind::input,
                RELUCENT_ENGLISH_MESSAGE("calibration.venue-not-simulated",
                                         "only a simulated venue's true light transport is known"),
                RELUCENT_ENGLISH_MESSAGE(
                    "calibration.simulate-or-compensate",
                    "calibrate one with --venue, or look at the prediction: relucent-cli compensate"));
  return openRig(measured.rig, cache, progress);
}

/// Judges projections by what they truly look like in the venue.
class Judge {
 public:
  Judge(const MeasuredCalibration& measured, const venue::SimulatedVenue& venue)
      : measured_(measured), venue_(venue), rasters_(measured.venue.transport.cameras()) {
    ProjectorStack white(measured.venue.transport.projectors().count() * 3, 1.0f);
    black_ = reduction::reducedRadiance(venue.trueBlack(), measured.reductions);
    brightest_ = reduction::reducedRadiance(venue.trueTransport().apply(white), measured.reductions);
    for (std::size_t i = 0; i < brightest_.size(); ++i) brightest_[i] += black_[i];
  }

  /// Pixels inside the target that the true venue can reach: e <= wanted <= T 1 + e in all channels.
  CameraMask reachable(const compensation::Target& target) const {
    CameraMask reachable = target.inside;
    for (std::size_t i = 0; i < target.wanted.size(); ++i)
      if (target.wanted[i] < black_[i] || target.wanted[i] > brightest_[i]) reachable[i / 3] = 0;
    return reachable;
  }

  std::size_t views() const { return rasters_.devices(); }

  /// What the cameras would see, free of noise.
  CameraStack seen(const compensation::Compensation& compensation) const {
    std::vector<image::Image> drive =
        encodedDrive(compensation.projector, measured_.venue.transport.projectors(), measured_.linearization);
    return reduction::reducedRadiance(venue_.trueRadiance(drive), measured_.reductions);
  }
  /// Of a stack of all cameras.
  image::Image view(const CameraStack& stack, std::size_t camera) const {
    return image::imageFromStack(stack, rasters_, camera);
  }
  CameraMask view(const CameraMask& mask, std::size_t camera) const {
    const auto begin = mask.begin() + static_cast<std::ptrdiff_t>(rasters_.offset(camera));
    return {begin, begin + static_cast<std::ptrdiff_t>(rasters_.size(camera).count())};
  }

  /// What a camera sees against what is wanted there.
  MethodScore score(compensation::Method method, const CameraStack& seen, const compensation::Target& target,
                    const CameraMask& reachable, std::size_t camera) const {
    const CameraMask inside = view(target.inside, camera), mask = view(reachable, camera);
    const image::Image wanted = view(target.wanted, camera), is = view(seen, camera);

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

 private:
  const MeasuredCalibration& measured_;
  const venue::SimulatedVenue& venue_;
  Rasters rasters_;
  CameraStack black_, brightest_;
};

double shareOf(const std::vector<std::uint8_t>& part, const std::vector<std::uint8_t>& whole) {
  std::size_t inPart = 0;
  std::size_t inWhole = 0;
  for (std::size_t i = 0; i < whole.size(); ++i) {
    inWhole += whole[i] != 0;
    inPart += whole[i] != 0 && part[i] != 0;
  }
  return inWhole > 0 ? static_cast<double>(inPart) / static_cast<double>(inWhole) : 0.0;
}

std::vector<NamedImage> contentOf(const EvaluateSettings& settings) {
  if (settings.images.empty()) return settings.fewImages ? standardImages() : judgedImages();
  std::vector<NamedImage> content;
  for (const fs::path& path : settings.images)
    content.push_back({path.stem().string(), image::readLinearContent(path)});
  return content;
}

std::vector<compensation::Method> methodsOf(const EvaluateSettings& settings) {
  return settings.methods.empty() ? allValues<compensation::Method>() : settings.methods;
}

}  // namespace

Evaluation evaluated(const MeasuredCalibration& measured, const EvaluateSettings& settings,
                     const fs::path& cache, Progress& progress) {
  std::vector<NamedImage> content = contentOf(settings);
  std::vector<compensation::Method> methods = methodsOf(settings);
  Progress opening = progress.part(0.2, RELUCENT_MESSAGE("stage.preparing-venue", "Preparing the venue"));
  OpenedRig devices = openedVenue(measured, cache, opening);
  const venue::SimulatedVenue& venue = devices.venue.value();

  Evaluation evaluation;
  EvaluateResult& result = evaluation.result;
  result.venue = venue.settings().name;
  result.projector = venue.settings().projector;
  result.camera = venue.settings().camera;
  result.transport = scoreOf(measured.venue.transport, venue, measured.reductions);

  Judge judge(measured, venue);
  compensation::Compensator compensator(measured.venue, measured.inverse, settings.compensator);
  Progress judging = progress.part(0.8, RELUCENT_MESSAGE("stage.comparing-methods", "Comparing the methods"));
  double share = 1.0 / static_cast<double>(content.size() * methods.size());
  for (const NamedImage& image : content) {
    compensation::Target target = fitTarget(image.linear, measured.venue, settings.target);
    CameraMask reachable = judge.reachable(target);
    const auto reachableOf = [&](std::size_t camera) {
      return shareOf(judge.view(reachable, camera), judge.view(target.inside, camera));
    };
    ImageScore score{image.name, reachableOf(0), {}};
    for (std::size_t camera = 1; camera < judge.views(); ++camera)
      score.others.push_back({reachableOf(camera), {}});
    EvaluatedPictures pictures{image.name,   judge.view(target.wanted, 0), {},
                               target.white, judge.view(target.inside, 0), score.reachable};
    for (compensation::Method method : methods) {
      Progress solving = judging.part(
          share,
          RELUCENT_ENGLISH_MESSAGE("stage.picture-and-method", "{}: {}").with(image.name, nameOf(method)));
      Stopwatch watch;
      compensation::Compensation compensation = compensator.solve(method, target, solving);
      double seconds = watch.seconds();
      const CameraStack seen = judge.seen(compensation);
      for (std::size_t camera = 0; camera < judge.views(); ++camera) {
        MethodScore of = judge.score(method, seen, target, reachable, camera);
        of.seconds = seconds;
        (camera == 0 ? score.methods : score.others[camera - 1].methods).push_back(of);
      }
      pictures.seen.emplace(method, judge.view(seen, 0));
    }
    result.reachable += score.reachable / static_cast<double>(content.size());
    result.images.push_back(std::move(score));
    evaluation.pictures.push_back(std::move(pictures));
  }
  progress.report(1.0);
  return evaluation;
}

double meanPsnr(const EvaluateResult& result, compensation::Method method) {
  double sum = 0.0;
  for (const ImageScore& image : result.images)
    for (const MethodScore& score : image.methods)
      if (score.method == method) sum += score.psnrReachable;
  return sum / static_cast<double>(result.images.size());
}

EvaluateResult evaluate(const fs::path& path, const EvaluateSettings& settings, const fs::path& cache,
                        Progress& progress) {
  if (std::vector<Message> found = problems(settings); !found.empty())
    throw Error(
        ErrorKind::input, found.front(),
        RELUCENT_ENGLISH_MESSAGE("settings.change-and-start-again", "change that setting and start again"));
  calibration::CalibrationFolder folder =
      calibration::CalibrationFolder::open(path, calibration::CalibrationFolder::Access::read);
  Progress loading =
      progress.part(0.2, RELUCENT_MESSAGE("stage.reading-calibration", "Reading the calibration"));
  MeasuredCalibration measured = loadCalibration(folder, loading);
  Progress evaluating = progress.part(0.8, RELUCENT_MESSAGE("stage.evaluating", "Evaluating"));
  return evaluated(measured, settings, cache, evaluating).result;
}

}  // namespace relucent::pipeline
