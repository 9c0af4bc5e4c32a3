// SPDX-License-Identifier: MIT
#include "relucent/pipeline/evaluate.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>
#include <optional>
#include <utility>

#include "relucent/base/error.h"
#include "relucent/base/random.h"
#include "relucent/base/stopwatch.h"
#include "relucent/compensation/black_steps.h"
#include "relucent/compensation/blending.h"
#include "relucent/compensation/contradiction.h"
#include "relucent/image/colour.h"
#include "relucent/image/metrics.h"
#include "relucent/image/picture_files.h"
#include "relucent/pipeline/devices.h"
#include "relucent/pipeline/evaluation.h"
#include "relucent/pipeline/perfecting_loop.h"
#include "relucent/pipeline/projection.h"
#include "relucent/pipeline/projection_photographs.h"
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
  /// `rasters`: of what its cameras see, reduced.
  Judge(const MeasuredCalibration& measured, const venue::SimulatedVenue& venue,
        std::vector<reduction::Reduction> reductions, Rasters rasters)
      : measured_(measured), venue_(venue), reductions_(std::move(reductions)), rasters_(std::move(rasters)) {
    black_ = reduction::reducedRadiance(venue.trueBlack(), reductions_);
    brightest_ = brightestOf(ProjectorStack(measured.venue.transport.projectors().count() * 3, 1.0f));
  }

  /// Pixels inside the target that the true venue can reach: e <= wanted <= T 1 + e in all channels.
  CameraMask reachable(const compensation::Target& target) const { return within(target, brightest_); }
  /// The part of them that is asked for at most `share` of T 1 in all channels.
  CameraMask roomy(const compensation::Target& target, float share) const {
    CameraStack light = black_;
    for (std::size_t i = 0; i < light.size(); ++i) light[i] += share * (brightest_[i] - black_[i]);
    return within(target, light);
  }
  /// The same with one projector alone.
  CameraMask reachableAlone(const compensation::Target& target, std::size_t projector) const {
    const Rasters& projectors = measured_.venue.transport.projectors();
    ProjectorStack white(projectors.count() * 3, 0.0f);
    const auto first = white.begin() + 3 * static_cast<std::ptrdiff_t>(projectors.offset(projector));
    std::fill_n(first, 3 * projectors.size(projector).count(), 1.0f);
    return within(target, brightestOf(white));
  }

  std::size_t views() const { return rasters_.devices(); }
  const CameraStack& black() const { return black_; }

  /// What the cameras would see, free of noise.
  CameraStack seen(const compensation::Compensation& compensation) const {
    std::vector<image::Image> drive =
        encodedDrive(compensation.projector, measured_.venue.transport.projectors(), measured_.linearization);
    return reduction::reducedRadiance(venue_.trueRadiance(drive), reductions_);
  }
  /// Of a stack of all cameras.
  image::Image view(const CameraStack& stack, std::size_t camera) const {
    return image::imageFromStack(stack, rasters_, camera);
  }
  CameraMask view(const CameraMask& mask, std::size_t camera) const {
    const auto begin = mask.begin() + static_cast<std::ptrdiff_t>(rasters_.offset(camera));
    return {begin, begin + static_cast<std::ptrdiff_t>(rasters_.size(camera).count())};
  }

  /// What a camera sees against what is wanted there; none if that is nothing.
  std::optional<MethodScore> scoreOf(compensation::Method method, const CameraStack& seen,
                                     const compensation::Target& target, const CameraMask& reachable,
                                     std::size_t camera) const {
    if (std::ranges::count(view(target.inside, camera), 0) == std::ssize(view(target.inside, camera)))
      return std::nullopt;
    return score(method, seen, target, reachable, camera);
  }

 private:
  CameraStack brightestOf(const ProjectorStack& white) const {
    CameraStack brightest = reduction::reducedRadiance(venue_.trueTransport().apply(white), reductions_);
    for (std::size_t i = 0; i < brightest.size(); ++i) brightest[i] += black_[i];
    return brightest;
  }
  CameraMask within(const compensation::Target& target, const CameraStack& brightest) const {
    CameraMask reachable = target.inside;
    for (std::size_t i = 0; i < target.wanted.size(); ++i)
      if (target.wanted[i] < black_[i] || target.wanted[i] > brightest[i]) reachable[i / 3] = 0;
    return reachable;
  }

  /// Where nothing is reachable there is no such error: NaN.  Contract: the content covers some of it.
  MethodScore score(compensation::Method method, const CameraStack& seen, const compensation::Target& target,
                    const CameraMask& reachable, std::size_t camera) const {
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

  const MeasuredCalibration& measured_;
  const venue::SimulatedVenue& venue_;
  std::vector<reduction::Reduction> reductions_;
  Rasters rasters_;
  CameraStack black_, brightest_;
};

/// What viewers are to see who stand where no camera does.
class UnseenPlaces {
 public:
  /// None: the venue has none.
  static std::optional<UnseenPlaces> of(const MeasuredCalibration& measured,
                                        const venue::SimulatedVenue& venue, Progress& progress) {
    std::optional<venue::SimulatedVenue> places = venue.fromHiddenPlaces(progress);
    if (!places) return std::nullopt;
    return UnseenPlaces(measured, *std::move(places));
  }

  const Judge& judge() const { return *judge_; }

  /// The content on the surface, where the first camera sees it.
  compensation::Target target(const compensation::Target& seen) const {
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

 private:
  UnseenPlaces(const MeasuredCalibration& measured, venue::SimulatedVenue places)
      : measured_(&measured), places_(std::make_unique<venue::SimulatedVenue>(std::move(places))) {
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

  const MeasuredCalibration* measured_;
  std::unique_ptr<venue::SimulatedVenue> places_;
  std::optional<Judge> judge_;
  compensation::ViewMap map_;
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

// Of what all projectors give a pixel: who is asked for more depends on what its neighbours have too much of.
constexpr float shareWithRoom = 0.7f;

/// At some flat greys, shaped as the content is.
std::vector<SeamScore> seamScores(const MeasuredCalibration& measured,
                                  const compensation::Compensator& compensator, const Judge& judge,
                                  Size content, const EvaluateSettings& settings) {
  const transport::TransportMatrix& transport = measured.venue.transport;
  std::vector<SeamScore> scores;
  for (double grey : {0.1, 0.25, 0.5, 0.75}) {
    const image::Image flat(content, 3, static_cast<float>(grey));
    const compensation::Target target = fitTarget(flat, measured.venue, settings.target);
    const CameraMask mask = judge.reachable(target);
    const auto seams = [&](const CameraStack& seen, const CameraMask& among) {
      const compensation::SeamPairs pairs =
          compensation::seamPairs(transport, among, compensation::seamApart, settings.compensator.direct);
      return compensation::seamsOf(seen, transport.cameras(), among, target.white, pairs);
    };
    Progress quiet;
    const compensation::Method method = methodsOf(settings).back();
    const CameraStack joint = judge.seen(compensator.solve(method, target, quiet)),
                      blended = judge.seen(
                          solvedSeparately(compensator, target, settings.compensator.optimum, quiet));
    scores.push_back({grey, method, seams(joint, mask), seams(blended, mask),
                      seams(joint, judge.roomy(target, shareWithRoom))});
  }
  return scores;
}

/// What the projectors make of an image without each other: blended, and each alone.
void judgeApart(const compensation::Compensator& compensator, const compensation::Target& target,
                const CameraMask& reachable, const Judge& judge, const compensation::SolverSettings& settings,
                ImageScore& score, Progress& progress) {
  const auto scoreOf = [&](const CameraStack& seen, std::size_t camera) {
    return judge.scoreOf(compensation::Method::optimum, seen, target, reachable, camera);
  };
  const CameraStack blended = judge.seen(solvedSeparately(compensator, target, settings, progress));
  for (std::size_t camera = 0; camera < judge.views(); ++camera)
    (camera == 0 ? score.blended : score.others[camera - 1].blended) = scoreOf(blended, camera);
  const std::size_t projectors = compensator.venue().transport.projectors().devices();
  for (std::size_t k = 0; projectors > 1 && k < projectors; ++k) {
    Progress quiet;
    const CameraStack seen = judge.seen(solvedAlone(compensator, target, k, settings, quiet));
    const CameraMask alone = judge.reachableAlone(target, k);
    for (std::size_t camera = 0; camera < judge.views(); ++camera)
      (camera == 0 ? score.alone : score.others[camera - 1].alone)
          .push_back(
              {shareOf(judge.view(alone, camera), judge.view(target.inside, camera)), scoreOf(seen, camera)});
  }
}

/// What others do with a picture, in all views.
void judgeRivals(compensation::RivalCompensator& rivals, const std::vector<compensation::Rival>& wanted,
                 const compensation::Target& target, const CameraMask& reachable, const Judge& judge,
                 ImageScore& score, Progress& progress) {
  for (const compensation::Rival rival : wanted) {
    Progress solving = progress.part(
        0.0, RELUCENT_ENGLISH_MESSAGE("stage.picture-and-method", "{}: {}").with(score.name, nameOf(rival)));
    const int before = rivals.photographs(rival);
    Stopwatch watch;
    const compensation::Compensation compensation = rivals.solve(rival, target, solving);
    const double seconds = watch.seconds();
    // Those of even colours serve every picture.
    const int taken = rivals.photographs(rival) - (rival == compensation::Rival::robust ? 0 : before);
    const CameraStack seen = judge.seen(compensation);
    for (std::size_t camera = 0; camera < judge.views(); ++camera) {
      std::optional<MethodScore> of =
          judge.scoreOf(compensation::Method::none, seen, target, reachable, camera);
      if (!of) continue;
      of->seconds = seconds;
      (camera == 0 ? score.rivals : score.others[camera - 1].rivals).push_back({rival, taken, *of});
    }
  }
}

/// What becomes of `refined` by photographs of it, in all views.
void judgePerfected(const compensation::Compensator& compensator, const compensation::Target& target,
                    ProjectionPhotographs& photographs, int most, const CameraMask& reachable,
                    const Judge& judge, ImageScore& score, Progress& progress) {
  constexpr compensation::Method method = compensation::Method::refined;
  Progress quiet;
  const PerfectingCamera camera{[&] { return photographs.black(quiet); },
                                [&](const ProjectorStack& drive) { return photographs.of(drive, quiet); }};
  const auto judged = [&](const PerfectingRound&, const ProjectorStack& drive) {
    compensation::Compensation shown;
    shown.projector = drive;
    const CameraStack seen = judge.seen(shown);
    for (std::size_t view = 0; view < judge.views(); ++view)
      if (std::optional<MethodScore> of = judge.scoreOf(method, seen, target, reachable, view))
        (view == 0 ? score.perfected : score.others[view - 1].perfected).push_back(*of);
  };
  perfected(compensator, target, compensator.solve(method, target, progress), camera, most, judged, quiet);
}

}  // namespace

Evaluation evaluated(const MeasuredCalibration& measured, const EvaluateSettings& settings,
                     const fs::path& cache, Progress& progress) {
  std::vector<NamedImage> content = contentOf(settings);
  std::vector<compensation::Method> methods = methodsOf(settings);
  Progress opening = progress.part(0.2, RELUCENT_MESSAGE("stage.preparing-venue", "Preparing the venue"));
  OpenedRig devices = openedVenue(measured, cache, opening);
  ProjectionPhotographs photographs(devices.rig, measured, "rivals");
  const venue::SimulatedVenue& venue = devices.venue.value();

  Evaluation evaluation;
  EvaluateResult& result = evaluation.result;
  result.venue = venue.settings().name;
  result.projector = venue.settings().projector;
  result.camera = venue.settings().camera;
  result.transport = scoreOf(measured.venue.transport, venue, measured.reductions);

  Judge judge(measured, venue, measured.reductions, measured.venue.transport.cameras());
  Progress tracing = progress.part(0.1, RELUCENT_MESSAGE("stage.preparing-venue", "Preparing the venue"));
  const std::optional<UnseenPlaces> unseen = UnseenPlaces::of(measured, venue, tracing);
  compensation::Compensator compensator(measured.venue, measured.inverse, settings.compensator);
  Progress photographing;
  compensation::RivalCompensator rivals(
      compensator, measured.inverse,
      [&](const ProjectorStack& linear) { return photographs.of(linear, photographing).radiance; },
      settings.rivalSettings);
  Progress judging = progress.part(0.7, RELUCENT_MESSAGE("stage.comparing-methods", "Comparing the methods"));
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
    std::optional<compensation::Target> elsewhere;
    CameraMask reachableElsewhere;
    if (unseen && !hasOwnPictures(target)) {
      elsewhere = unseen->target(target);
      reachableElsewhere = unseen->judge().reachable(*elsewhere);
      for (std::size_t place = 0; place < unseen->judge().views(); ++place)
        score.unseen.push_back({shareOf(unseen->judge().view(reachableElsewhere, place),
                                        unseen->judge().view(elsewhere->inside, place)),
                                {}});
    }
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
        std::optional<MethodScore> of = judge.scoreOf(method, seen, target, reachable, camera);
        if (!of) continue;
        of->seconds = seconds;
        (camera == 0 ? score.methods : score.others[camera - 1].methods).push_back(*of);
      }
      if (elsewhere) {
        const CameraStack seenElsewhere = unseen->judge().seen(compensation);
        for (std::size_t place = 0; place < score.unseen.size(); ++place) {
          std::optional<MethodScore> of =
              unseen->judge().scoreOf(method, seenElsewhere, *elsewhere, reachableElsewhere, place);
          if (!of) continue;
          of->seconds = seconds;
          score.unseen[place].methods.push_back(*of);
        }
      }
      pictures.seen.emplace(method, judge.view(seen, 0));
      if (judge.views() > 1 && method == methods.back()) {
        Progress comparing;
        const compensation::Contradiction contradiction =
            contradictionOf(compensator, target, compensation, comparing);
        score.contradiction = {contradiction.share, contradiction.shares};
      }
    }
    judgeRivals(rivals, settings.rivals, target, reachable, judge, score, judging);
    if (settings.perfected > 0) {
      Progress perfecting = judging.part(
          0.0, RELUCENT_MESSAGE("stage.perfecting", "Correcting the picture by photographs of itself"));
      judgePerfected(compensator, target, photographs, settings.perfected, reachable, judge, score,
                     perfecting);
    }
    if (settings.blended) {
      Progress solving = judging.part(
          0.0, RELUCENT_ENGLISH_MESSAGE("stage.solving-separately", "{}: each projector on its own")
                   .with(image.name));
      judgeApart(compensator, target, reachable, judge, settings.compensator.optimum, score, solving);
    }
    result.reachable += score.reachable / static_cast<double>(content.size());
    result.images.push_back(std::move(score));
    evaluation.pictures.push_back(std::move(pictures));
  }
  if (settings.blended)
    result.seams = seamScores(measured, compensator, judge, content.front().linear.size(), settings);
  if (settings.blended) {
    const compensation::Target target = fitTarget(content.front().linear, measured.venue, settings.target);
    const compensation::SeamPairs pairs = compensation::seamPairs(
        measured.venue.transport, target.inside, compensation::seamApart, settings.compensator.direct);
    result.blackSteps = {target.blackLift, blackSteps(measured.venue, target, pairs, target.blackLift).p95,
                         leastBlackLift(measured.venue, target, pairs)};
  }
  if (settings.walk.frames > 0) {
    const auto judged = [&](const compensation::Compensation& shown, const compensation::Target& target) {
      WalkSight sight;
      const auto scores = [&](const Judge& by, const compensation::Target& wanted,
                              std::vector<double>& psnr) {
        const CameraStack seen = by.seen(shown);
        const CameraMask reachable = by.reachable(wanted);
        for (std::size_t view = 0; view < by.views(); ++view) {
          const auto score = by.scoreOf(compensation::Method::refined, seen, wanted, reachable, view);
          psnr.push_back(score ? score->psnrReachable : std::numeric_limits<double>::quiet_NaN());
          sight.views.push_back(image::viewed(by.view(seen, view), wanted.white));
        }
      };
      scores(judge, target, sight.psnr);
      if (unseen && !hasOwnPictures(target)) scores(unseen->judge(), unseen->target(target), sight.unseen);
      return sight;
    };
    Progress walking =
        progress.part(0.0, RELUCENT_ENGLISH_MESSAGE("stage.following-viewer", "Following a viewer"));
    result.walk = walk(measured, content.front().linear, settings.target, settings.walk, judged, walking);
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
  if (settings.rig) measured.rig = *settings.rig;
  Progress evaluating = progress.part(0.8, RELUCENT_MESSAGE("stage.evaluating", "Evaluating"));
  return evaluated(measured, settings, cache, evaluating).result;
}

}  // namespace relucent::pipeline
