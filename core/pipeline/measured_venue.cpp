// SPDX-License-Identifier: MIT
#include "relucent/pipeline/measured_venue.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "relucent/base/error.h"
#include "relucent/base/parallel.h"
#include "relucent/calibration/results.h"
#include "relucent/calibration/stage_progress.h"
#include "relucent/compensation/direct_light.h"
#include "relucent/compensation/row_trust.h"
#include "relucent/pipeline/kept_windows.h"
#include "relucent/pipeline/not_finished.h"
#include "relucent/pipeline/reductions.h"
#include "relucent/pipeline/stored_settings.h"
#include "relucent/transport/difference.h"

namespace relucent::pipeline {
namespace {

/// `stored`: what is read of the acquisition on the way.
MeasuredCalibration read(const calibration::CalibrationFolder& folder, Held held,
                         transport::Acquisition& stored, Progress& progress) {
  CalibrateSettings settings = settingsOf(folder);
  // While it is measured again, with these or other settings, the earlier measurement is used.
  auto linearization = calibration::resultOf(folder, calibration::Stage::linearization);
  auto acquisition = calibration::resultOf(folder, calibration::Stage::acquisition);
  if (!linearization || !acquisition) throw notFinished(folder.path());
  MeasuredCalibration measured;
  measured.rig = settings.rig;
  measured.reductions = reductionsOf(folder);
  measured.linearization = calibration::loadLinearization(*linearization);
  progress.report(0.1);
  stored = calibration::loadAcquisition(*acquisition);
  progress.report(0.7);
  measured.acquisition = figuresOf(stored);
  measured.venue = measuredVenueOf(stored, settings.threshold);
  if (held == Held::allMeasured && !transport::cutsNothing(settings.threshold))
    measured.venue.uncut = std::make_shared<const transport::TransportMatrix>(
        transport::rescaledToFloodlight(stored.transport, stored.flood));
  progress.report(1.0);
  return measured;
}

}  // namespace

MeasuredCalibration loadMeasurements(const calibration::CalibrationFolder& folder, Progress& progress) {
  transport::Acquisition stored;
  return read(folder, Held::whatIsLeft, stored, progress);
}

CameraMask usablePixels(const transport::Acquisition& acquisition) {
  // Below this share of the venue's bright pixels, compensating would ask for many times the projector's
  // power; and a pixel has to stand out of its own noise before it can be relied on.
  constexpr float leastShare = 0.02f;
  constexpr float leastSigmas = 5.0f;

  std::size_t pixels = acquisition.flood.size() / 3;
  std::vector<float> darkest(pixels);
  for (std::size_t i = 0; i < pixels; ++i)
    darkest[i] =
        std::min({acquisition.flood[3 * i], acquisition.flood[3 * i + 1], acquisition.flood[3 * i + 2]});
  std::vector<float> sorted = darkest;
  auto p95 = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() * 95 / 100);
  std::nth_element(sorted.begin(), p95, sorted.end());
  float least = leastShare * *p95;

  CameraMask usable(pixels);
  for (std::size_t i = 0; i < pixels; ++i) {
    float variance = std::max({acquisition.floodVariance[3 * i], acquisition.floodVariance[3 * i + 1],
                               acquisition.floodVariance[3 * i + 2]});
    bool lit = darkest[i] > least && darkest[i] > leastSigmas * std::sqrt(variance);
    usable[i] = lit && acquisition.flagged[i] == 0;
  }
  return usable;
}

namespace {

compensation::TransportVariance varianceOf(const transport::Acquisition& acquisition) {
  return {acquisition.blackVariance, acquisition.floodVariance, acquisition.leafVariance};
}

}  // namespace

AcquisitionFigures figuresOf(const transport::Acquisition& acquisition) {
  return {acquisition.flagged, varianceOf(acquisition), acquisition.unresolvedEnergy,
          acquisition.verificationError, acquisition.findings};
}

namespace {

/// All that does not depend on which light is direct.
compensation::MeasuredVenue venueOf(const transport::Acquisition& acquisition,
                                    const transport::ThresholdSettings& threshold) {
  compensation::MeasuredVenue venue;
  venue.usable = usablePixels(acquisition);
  venue.transport = transport::thresholded(acquisition.transport, threshold, acquisition.flood);
  venue.black = acquisition.black;
  venue.flood = acquisition.flood;
  return venue;
}

void addWhatFollows(compensation::MeasuredVenue& venue, const transport::Acquisition& acquisition) {
  venue.views = compensation::viewMap(venue.transport, compensation::seesProjection(venue));
  venue.trust = compensation::trustIn(venue, varianceOf(acquisition));
}

}  // namespace

compensation::MeasuredVenue measuredVenueOf(const transport::Acquisition& acquisition,
                                            const transport::ThresholdSettings& threshold) {
  compensation::MeasuredVenue venue = venueOf(acquisition, threshold);
  Progress quiet;
  venue.direct = compensation::directlyLit(compensation::directLooks(venue.transport, {}, quiet));
  addWhatFollows(venue, acquisition);
  return venue;
}

RenewedVenue renewedVenueOf(const transport::Acquisition& acquisition,
                            const transport::ThresholdSettings& threshold,
                            const compensation::MeasuredVenue& former) {
  compensation::MeasuredVenue venue = venueOf(acquisition, threshold);
  CameraMask changed = transport::differingRows(venue.transport, former.transport);
  venue.direct = compensation::renewedDirectlyLit(former.direct, former.transport, venue.transport, changed);
  addWhatFollows(venue, acquisition);
  for (std::size_t row = 0; row < changed.size(); ++row)
    if (venue.usable[row] != former.usable[row]) changed[row] = 1;
  return {std::move(venue), std::move(changed)};
}

namespace {

/// Pairs of a camera pixel and a projector pixel that the leaves connect; nested leaves count once each.
std::uint64_t connectionsOf(const transport::TransportMatrix& transport) {
  std::array<std::uint64_t, fixedParts> connections{};
  const transport::NodeLayout& layout = transport.layout();
  parallelChunks(0, transport.cameras().count(), fixedParts,
                 [&](std::size_t part, std::size_t first, std::size_t last) {
                   for (std::size_t row = first; row < last; ++row) {
                     const transport::LeafRow leaves = transport.row(row);
                     transport::NodeCursor nodeAt(layout);
                     for (std::uint32_t column : leaves.columns())
                       connections[part] += static_cast<std::uint64_t>(layout.block(nodeAt(column)).count());
                   }
                 });
  return std::reduce(connections.begin(), connections.end());
}

/// What the stage cost that is in use.
template <calibration::Stage stage>
calibration::StageCost costOf(const calibration::CalibrationFolder& folder) {
  const std::optional<calibration::StageResult> stored = calibration::resultOf(folder, stage);
  return stored ? resultFrom<stage>(*stored).cost.value_or(calibration::StageCost())
                : calibration::StageCost();
}

}  // namespace

CalibrateResult summaryOf(const calibration::CalibrationFolder& folder, const MeasuredCalibration& measured) {
  CalibrateResult result;
  const calibration::StageCost linearization = costOf<calibration::Stage::linearization>(folder),
                               acquiring = costOf<calibration::Stage::acquisition>(folder);
  result.patterns = linearization.patterns + acquiring.patterns;
  result.exposures = linearization.exposures + acquiring.exposures;
  result.linearizationExposures = linearization.exposures;
  result.seconds.linearization = linearization.seconds;
  result.seconds.acquisition = acquiring.seconds;
  result.seconds.inverse = costOf<calibration::Stage::inverse>(folder).seconds;
  const AcquisitionFigures& acquisition = measured.acquisition;
  result.leaves = measured.venue.transport.storedLeaves();
  result.connections = connectionsOf(measured.venue.transport);
  result.unresolvedEnergy = acquisition.unresolvedEnergy;
  result.verificationError = acquisition.verificationError;
  auto flagged = static_cast<double>(
      acquisition.flagged.size() -
      static_cast<std::size_t>(std::count(acquisition.flagged.begin(), acquisition.flagged.end(), 0)));
  result.flaggedShare = flagged / static_cast<double>(acquisition.flagged.size());
  result.findings = measured.linearization.findings;
  result.findings.insert(result.findings.end(), acquisition.findings.begin(), acquisition.findings.end());
  const compensation::MeasuredVenue& venue = measured.venue;
  for (std::size_t camera : compensation::camerasApart(venue.views, venue.transport.cameras()))
    result.findings.push_back(
        RELUCENT_ENGLISH_MESSAGE(
            "calibration.camera-sees-other-places",
            "camera {} sees no lit place that another camera sees: no picture lies in its "
            "view; aim it where the others look and measure again, or give it a picture "
            "of its own")
            .with(as::label(camera + 1)));
  return result;
}

compensation::MeasuredVenue loadMeasuredVenue(const calibration::CalibrationFolder& folder,
                                              Progress& progress) {
  return loadMeasurements(folder, progress).venue;
}

compensation::RidgeChoice invert(const compensation::MeasuredVenue& venue, const CalibrateSettings& settings,
                                 Progress& progress) {
  if (settings.chooseRidge) return chooseRidge(venue, settings.windows, progress);
  return {settings.windows.ridge,
          {},
          inverse::computeWindows(venue.transport, venue.usable, settings.windows, progress)};
}

calibration::InverseResult inverseResultOf(const compensation::RidgeChoice& choice,
                                           const calibration::StageCost& cost) {
  calibration::InverseResult result{choice.ridge, {}, choice.inverse.bytes(), cost};
  for (const compensation::RidgeTrial& trial : choice.curve)
    result.curve.push_back({trial.ridge, trial.psnr});
  return result;
}

namespace {

void readOrMakeWindows(MeasuredCalibration& measured, const calibration::CalibrationFolder& folder,
                       Progress& progress) {
  Progress inverting = progress.part(
      0.5, RELUCENT_MESSAGE("stage.inverting-light-transport", "Inverting the light transport"));
  CalibrateSettings settings = settingsOf(folder);
  // Which ridge is best has been tried already, unless an older version made the calibration.
  if (const auto stored = calibration::currentResultOf(folder, calibration::Stage::inverse)) {
    const calibration::InverseResult done = resultFrom<calibration::Stage::inverse>(*stored);
    settings.windows.ridge = done.ridge.value_or(settings.windows.ridge);
    settings.chooseRidge = false;
    for (const calibration::InverseResult::Trial& trial : done.curve)
      measured.ridgeCurve.push_back({trial.ridge, trial.psnr});
  }
  if (!settings.chooseRidge)
    if (std::optional<inverse::WindowInverse> kept = keptWindows(folder, measured.venue, settings.windows)) {
      measured.ridge = settings.windows.ridge;
      measured.inverse = std::move(*kept);
      inverting.report(1.0);
      return;
    }
  compensation::RidgeChoice choice = invert(measured.venue, settings, inverting);
  measured.ridge = choice.ridge;
  measured.inverse = std::move(choice.inverse);
  if (measured.ridgeCurve.empty()) measured.ridgeCurve = std::move(choice.curve);
}

}  // namespace

MeasuredCalibration loadCalibration(const calibration::CalibrationFolder& folder, Progress& progress,
                                    Held held) {
  MeasuredCalibration measured;
  {
    Progress reading =
        progress.part(0.5, RELUCENT_MESSAGE("stage.reading-calibration", "Reading the calibration"));
    transport::Acquisition stored;  // is let go of before there are windows
    measured = read(folder, held, stored, reading);
  }
  readOrMakeWindows(measured, folder, progress);
  return measured;
}

MeasuredCalibration loadCalibration(const calibration::CalibrationFolder& folder,
                                    transport::Acquisition& acquisition, Progress& progress) {
  Progress reading =
      progress.part(0.5, RELUCENT_MESSAGE("stage.reading-calibration", "Reading the calibration"));
  MeasuredCalibration measured = read(folder, Held::whatIsLeft, acquisition, reading);
  readOrMakeWindows(measured, folder, progress);
  return measured;
}

}  // namespace relucent::pipeline
