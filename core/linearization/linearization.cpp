// SPDX-License-Identifier: MIT
#include "relucent/linearization/linearization.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "relucent/base/error.h"
#include "relucent/linearization/additivity.h"
#include "relucent/linearization/camera_noise.h"
#include "relucent/linearization/camera_response.h"
#include "relucent/linearization/exposure_choice.h"
#include "relucent/linearization/mosaic_evaluation.h"
#include "relucent/linearization/mosaic_photographs.h"
#include "relucent/linearization/mosaic_photography.h"
#include "relucent/linearization/test_light.h"
#include "relucent/linearization/thinning.h"
#include "relucent/rig/projector_names.h"

namespace relucent::linearization {
namespace {

constexpr double flickerLimit = 0.01;     // of the light between photographs, relative
constexpr double unevennessLimit = 0.02;  // of the response over the picture, of white

/// White at the exposures from the longest to the shortest that were chosen: `times` are told by these.
rig::Shot whiteBracket(const ExposureChoice& choice) {
  std::vector<double> seconds;
  for (const rig::Shot& shot : choice.whites)
    for (double asked : shot.exposuresAsked)
      if (asked <= choice.seconds.front() && asked >= choice.seconds.back()) seconds.push_back(asked);
  std::optional<rig::Shot> bracket = atExposures(choice.whites, seconds);
  require(bracket.has_value(), "white was not photographed at the exposures that were chosen");
  return *std::move(bracket);
}

/// All photographs of white, for the cameras' responses.
rig::Shot allWhites(const ExposureChoice& choice) {
  std::vector<double> seconds;
  for (const rig::Shot& shot : choice.whites)
    seconds.insert(seconds.end(), shot.exposuresAsked.begin(), shot.exposuresAsked.end());
  return atExposures(choice.whites, seconds).value();
}

/// Response and true times of every camera; noise is not known yet. Few photographs say whether a camera is
/// linear. One that is not gets more, which say what it is.
std::vector<hdr::CameraModel> respondingCameras(rig::ShotTaker& shots, const ExposureChoice& choice,
                                                const Thinning& thinning,
                                                const LinearizationSettings& settings, Progress& progress) {
  const rig::Rig& rig = shots.rig();
  const rig::Shot whites = allWhites(choice), bracket = whiteBracket(choice);
  std::optional<rig::Shot> dense;
  std::vector<hdr::CameraModel> cameras;
  for (std::size_t camera = 0; camera < rig.cameras.size(); ++camera) {
    progress.checkpoint();
    hdr::CameraModel model;
    model.saturation = choice.saturation[camera];
    if (!looksLinear(whites, camera, model.saturation)) {
      if (!dense)
        dense = thinning.of(shots.take(randomGreys(rig, settings.seed),
                                       responseBracket(commonRange(rig), choice.seconds), progress));
      model.response = cameraResponse(*dense, camera, model.saturation).curves;
    }
    cameras.push_back(withMeasuredTimes(std::move(model), {{bracket, bracket}}, camera));
  }
  return cameras;
}

/// Pairs of equal shots beyond those that the mosaics contain, for `noisePairs`.
std::vector<ShotPair> takePairs(rig::ShotTaker& shots, const Thinning& thinning, int count,
                                const std::vector<double>& exposures, Progress& progress) {
  constexpr std::array<float, 4> drives{0.75f, 0.5f, 0.25f, 0.1f};
  std::vector<ShotPair> pairs;
  for (int i = 0; i < count; ++i) {
    float drive = drives[static_cast<std::size_t>(i) % drives.size()];
    std::vector<image::Image> patterns = evenPatterns(shots.rig(), {drive, drive, drive});
    rig::Shot first = thinning.of(shots.take(patterns, exposures, progress));
    pairs.emplace_back(std::move(first), thinning.of(shots.take(patterns, exposures, progress)));
    progress.report((i + 1.0) / count);
  }
  return pairs;
}

/// Black at the exposures for dim light, and as it was photographed to choose them.
rig::Shot blackOf(rig::ShotTaker& shots, const ExposureChoice& choice, const Thinning& thinning,
                  Progress& progress) {
  rig::Shot black = thinning.of(shots.take(evenPatterns(shots.rig(), {0, 0, 0}), choice.dim, progress));
  for (std::size_t exposure = 0; exposure < choice.black.frames.size(); ++exposure) {
    const double asked = choice.black.exposuresAsked[exposure];
    if (std::ranges::count(black.exposuresAsked, asked) > 0) continue;
    black.exposuresAsked.push_back(asked);
    black.frames.push_back(choice.black.frames[exposure]);
  }
  return black;
}

/// Of the signals brought back to light, of all cameras.
std::optional<double> blackShareOf(const ExposureChoice& choice,
                                   const std::vector<hdr::CameraModel>& cameras) {
  const double seconds = choice.black.exposuresAsked.back();
  const std::optional<rig::Shot> white = atExposures(choice.whites, {seconds});
  if (!white) return std::nullopt;
  const auto sum = [&](const std::vector<rig::RawFrame>& frames) {
    double light = 0.0;
    for (std::size_t camera = 0; camera < frames.size(); ++camera) {
      const std::vector<float>& signal = frames[camera].signal.data();
      for (std::size_t i = 0; i < signal.size(); ++i)
        light += cameras[camera].response[i % 3](static_cast<double>(signal[i]));
    }
    return light;
  };
  const double dark = sum(choice.black.frames.back()), lit = sum(white->frames.front());
  return lit > 0.0 ? std::optional(std::max(0.0, dark / lit)) : std::nullopt;
}

void addFindings(std::vector<Message>& findings, const MosaicResult& measured, const std::string& projector,
                 double additivityLimit) {
  const std::vector<Message> additivity = additivityFindings(measured.additivity, projector, additivityLimit);
  findings.insert(findings.end(), additivity.begin(), additivity.end());
  // Light that does not add up looks uneven as well.
  if (additivity.empty() && measured.unevenness > unevennessLimit)
    findings.push_back(
        RELUCENT_MESSAGE(
            "linearization.response-uneven",
            "{}: the brightness curves are not the same everywhere in its picture, by up to {} % of white; "
            "switch off uniformity correction, local dimming and edge blending in the projector")
            .with(projector, as::share(measured.unevenness, as::decimals(0))));
}

/// Per camera, of the projector whose light flickers most.
void addFlicker(std::vector<Message>& findings, const rig::Rig& rig, const std::vector<double>& flicker) {
  for (std::size_t camera = 0; camera < flicker.size(); ++camera)
    if (flicker[camera] > flickerLimit)
      findings.push_back(
          RELUCENT_MESSAGE("linearization.light-flickers",
                           "{}: the light changes by {} % from one photograph to the next; switch off the "
                           "projector's dynamic lamp modes and other lamps nearby, and choose exposure times "
                           "that are multiples of the mains period")
              .with(rig.cameras[camera]->name(), as::share(flicker[camera], as::decimals(1))));
}

}  // namespace

std::vector<Message> problems(const LinearizationSettings& settings) {
  std::vector<Message> found;
  if (settings.levels < 5 || settings.levels > 1025)
    found.push_back(RELUCENT_ENGLISH_MESSAGE("linearization.ramp-levels-out-of-range",
                                             "a ramp has 5 to 1025 levels, not {}")
                        .with(settings.levels));
  if (!(settings.shadowPower >= 0.5 && settings.shadowPower <= 4.0))
    found.push_back(RELUCENT_ENGLISH_MESSAGE("linearization.shadow-power-out-of-range",
                                             "the shadow power is between 0.5 and 4, not {}")
                        .with(settings.shadowPower));
  if (settings.noisePairs < 1 || settings.noisePairs > 100)
    found.push_back(RELUCENT_ENGLISH_MESSAGE("linearization.noise-pairs-out-of-range",
                                             "the camera's noise takes 1 to 100 pairs of shots, not {}")
                        .with(settings.noisePairs));
  if (!(settings.additivityLimit > 0.0 && settings.additivityLimit < 1.0))
    found.push_back(RELUCENT_ENGLISH_MESSAGE("linearization.additivity-limit-out-of-range",
                                             "the additivity limit is between 0 and 1, not {}")
                        .with(settings.additivityLimit));
  if (!(settings.exposureUnit >= 0.0 && settings.exposureUnit < 1.0))
    found.push_back(RELUCENT_ENGLISH_MESSAGE("linearization.exposure-unit-out-of-range",
                                             "a lamp's period is between 0 and 1 s, not {} s")
                        .with(settings.exposureUnit));
  return found;
}

Linearization linearize(rig::ShotTaker& shots, const LinearizationSettings& settings, Progress& progress) {
  for (const Message& problem : problems(settings)) require(false, "{}", problem);
  const rig::Rig& rig = shots.rig();
  require(!rig.projectors.empty() && !rig.cameras.empty(), "{} projectors and {} cameras make no rig",
          rig.projectors.size(), rig.cameras.size());

  Linearization result;
  Progress exposing = progress.part(0.1, RELUCENT_MESSAGE("stage.finding-exposure", "Finding the exposure"));
  ExposureChoice choice = chooseExposures(shots, exposing, settings.exposureUnit);
  result.exposures = choice.seconds;
  const Thinning thinning(rig.cameraRasters());
  for (rig::Shot& white : choice.whites) white = thinning.of(white);
  choice.black = thinning.of(choice.black);
  result.findings = choice.findings;

  Progress calibrating =
      progress.part(0.05, RELUCENT_MESSAGE("stage.measuring-camera", "Measuring the camera"));
  std::vector<hdr::CameraModel> cameras = respondingCameras(shots, choice, thinning, settings, calibrating);

  result.blackShare = blackShareOf(choice, cameras);
  rig::Shot black = blackOf(shots, choice, thinning, progress);
  Progress mosaics = progress.part(0.75, progress.stage());
  const MosaicPhotographs photographs = photographMosaics(shots, cameras, choice, black, settings, mosaics);
  std::vector<ShotPair> pairs{photographs.white,
                              {*atExposures({photographs.blackBefore}, choice.dim), photographs.blackAfter}};
  Progress pairing = progress.part(0.05, RELUCENT_MESSAGE("stage.measuring-camera", "Measuring the camera"));
  for (ShotPair& pair : takePairs(shots, thinning, settings.noisePairs - 2, choice.seconds, pairing))
    pairs.push_back(std::move(pair));
  for (std::size_t camera = 0; camera < cameras.size(); ++camera)
    result.cameras.push_back(withMeasuredNoise(cameras[camera], pairs, camera));

  Progress checking = progress.part(
      0.05, RELUCENT_MESSAGE("stage.checking-additivity", "Checking that the colours of {} add up")
                .with(rig::projectorNames(rig)));
  std::vector<double> flicker(rig.cameras.size(), 0.0);
  std::vector<MosaicResult> measured = evaluateMosaics(photographs, result.cameras, thinning, checking);
  for (std::size_t projector = 0; projector < measured.size(); ++projector) {
    MosaicResult& own = measured[projector];
    result.additivityError.push_back(
        std::max(std::abs(own.additivity.white), std::abs(own.additivity.superposition)));
    addFindings(result.findings, own, rig.projectors[projector]->name(), settings.additivityLimit);
    for (std::size_t camera = 0; camera < flicker.size(); ++camera)
      flicker[camera] = std::max(flicker[camera], own.flicker[camera]);
    result.projectors.push_back(std::move(own.response));
  }
  addFlicker(result.findings, rig, flicker);
  progress.report(1.0);
  result.times = shots.times();
  return result;
}

int usualShots(const LinearizationSettings& settings, std::size_t projectors) {
  constexpr int ofAll = 8;  // exposures; a group of all in white; white and black at the end
  const MosaicOrder order{projectors};
  const int levels = static_cast<int>(order.lights()) - 1;  // in a mosaic
  const int mosaics = (3 * (settings.levels - 2) + levels - 1) / levels;
  const int known = projectors == 1 ? 1 : 0;  // white of one alone: the exposures took it
  return ofAll + static_cast<int>(projectors * order.own()) + mosaics - known;
}

}  // namespace relucent::linearization
