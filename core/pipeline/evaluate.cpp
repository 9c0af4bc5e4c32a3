// SPDX-License-Identifier: MIT
#include "relucent/pipeline/evaluate.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "relucent/base/error.h"
#include "relucent/base/stopwatch.h"
#include "relucent/compensation/black_steps.h"
#include "relucent/compensation/blending.h"
#include "relucent/compensation/contradiction.h"
#include "relucent/image/colour.h"
#include "relucent/image/picture_files.h"
#include "relucent/pipeline/devices.h"
#include "relucent/pipeline/evaluation.h"
#include "relucent/pipeline/judge.h"
#include "relucent/pipeline/mask_score.h"
#include "relucent/pipeline/perfecting_loop.h"
#include "relucent/pipeline/projection.h"
#include "relucent/pipeline/projection_photographs.h"
#include "relucent/pipeline/sets.h"
#include "relucent/pipeline/standard_images.h"

namespace relucent::pipeline {
namespace fs = std::filesystem;
namespace {

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

double shareOf(const std::vector<std::uint8_t>& part, const std::vector<std::uint8_t>& whole) {
  std::size_t inPart = 0;
  std::size_t inWhole = 0;
  for (std::size_t i = 0; i < whole.size(); ++i) {
    inWhole += whole[i] != 0;
    inPart += whole[i] != 0 && part[i] != 0;
  }
  return inWhole > 0 ? static_cast<double>(inPart) / static_cast<double>(inWhole) : 0.0;
}

/// Of what is shown, with the codes of a projector: they are no errors of T.
std::optional<double> asExpected(const MeasuredCalibration& measured, const compensation::Target& target,
                                 const compensation::Compensation& compensation, const CameraStack& seen) {
  const compensation::MeasuredVenue& venue = measured.venue;
  if (measured.acquisition.variance.leaf.empty()) return std::nullopt;
  const Rasters& projectors = venue.transport.projectors();
  const ProjectorStack shown = lightOf(codedDrive(compensation.projector, projectors, measured.linearization),
                                       projectors, measured.linearization);
  const CameraStack predicted = venue.transport.apply(shown),
                    deviation = expectedDeviation(venue.transport, measured.acquisition.variance, shown);
  std::size_t all = 0, within = 0;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    if (target.inside[i / 3] == 0 || venue.usable[i / 3] == 0) continue;
    ++all;
    within += std::abs(seen[i] - predicted[i] - venue.black[i]) <= compensation::within95 * deviation[i];
  }
  if (all == 0) return std::nullopt;
  return static_cast<double>(within) / static_cast<double>(all);
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
  result.transport = transportScore(measured.venue.transport, venue, measured.reductions);

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
    const auto viewed = [&](const CameraStack& light) {
      return underEvenWhite(light, target, measured.venue.transport.cameras(), 0);
    };
    EvaluatedPictures pictures{image.name,   viewed(target.wanted),        {},
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
      pictures.seen.emplace(method, viewed(seen));
      if (method == methods.back()) score.asExpected = asExpected(measured, target, compensation, seen);
      if (judge.views() > 1 && method == methods.back()) {
        Progress comparing;
        const compensation::Contradiction contradiction =
            contradictionOf(compensator, target, compensation, comparing);
        score.contradiction = {contradiction.share, contradiction.shares};
      }
    }
    if (settings.target.masks && !settings.target.masks->empty()) {
      Progress untold;
      score.masked = maskScore(compensator, judge, methods.back(), image.linear, settings.target, untold);
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
  const calibration::CalibrationFolder folder = openWithSet(path, settings.set);
  Progress loading =
      progress.part(0.2, RELUCENT_MESSAGE("stage.reading-calibration", "Reading the calibration"));
  MeasuredCalibration measured = loadCalibration(folder, loading);
  if (settings.rig) measured.rig = *settings.rig;
  Progress evaluating = progress.part(0.8, RELUCENT_MESSAGE("stage.evaluating", "Evaluating"));
  EvaluateSettings masked = settings;
  masked.target = targetIn(folder, settings.set, settings.target);
  return evaluated(measured, masked, cache, evaluating).result;
}

}  // namespace relucent::pipeline
