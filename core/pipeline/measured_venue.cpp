// SPDX-License-Identifier: MIT
#include "pipeline/measured_venue.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.h"
#include "calibration/results.h"
#include "compensation/direct_light.h"
#include "pipeline/settings_json.h"
#include "pipeline/stages.h"

namespace relucent {
namespace {

/// Everything but the inverse.
MeasuredCalibration loadMeasurements(const CalibrationFolder& folder, Progress& progress) {
  CalibrateSettings settings = settingsOf(folder);
  auto linearization = folder.find(stage::linearization, linearizationFingerprint(folder));
  auto acquisition = folder.find(stage::acquisition, acquisitionFingerprint(folder));
  if (!linearization || !acquisition)
    throw Error(ErrorKind::input, "the calibration is not finished",
                fmt::format("finish it first: relucent-cli resume {}", folder.path().string()),
                folder.path().string());
  MeasuredCalibration measured;
  measured.rig = settings.rig;
  measured.linearization = loadLinearization(*linearization);
  progress.report(0.1);
  measured.acquisition = loadAcquisition(*acquisition);
  progress.report(0.7);
  measured.venue = takeMeasuredVenue(measured.acquisition, settings.threshold);
  progress.report(1.0);
  return measured;
}

}  // namespace

std::vector<std::uint8_t> usablePixels(const Acquisition& acquisition) {
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

  std::vector<std::uint8_t> usable(pixels);
  for (std::size_t i = 0; i < pixels; ++i) {
    float variance = std::max({acquisition.floodVariance[3 * i], acquisition.floodVariance[3 * i + 1],
                               acquisition.floodVariance[3 * i + 2]});
    bool lit = darkest[i] > least && darkest[i] > leastSigmas * std::sqrt(variance);
    usable[i] = lit && acquisition.flagged[i] == 0;
  }
  return usable;
}

namespace {

MeasuredVenue venueOf(TransportMatrix transport, const Acquisition& acquisition) {
  MeasuredVenue venue;
  venue.usable = usablePixels(acquisition);
  venue.transport = std::move(transport);
  venue.black = acquisition.black;
  venue.flood = acquisition.flood;
  Progress quiet;
  venue.direct = directlyLit(directLooks(venue.transport, {}, quiet));
  return venue;
}

}  // namespace

MeasuredVenue takeMeasuredVenue(Acquisition& acquisition, const ThresholdSettings& threshold) {
  TransportMatrix transport =
      thresholded(std::exchange(acquisition.transport, {}), threshold, acquisition.flood);
  return venueOf(std::move(transport), acquisition);
}

MeasuredVenue measuredVenueOf(const Acquisition& acquisition, const ThresholdSettings& threshold) {
  return venueOf(thresholded(acquisition.transport, threshold, acquisition.flood), acquisition);
}

namespace {

/// Pairs of a camera pixel and a projector pixel that the leaves connect; nested leaves count once each.
std::uint64_t connectionsOf(const TransportMatrix& transport) {
  std::uint64_t connections = 0;
  const BlockSparse& leaves = transport.leaves();
  const NodeLayout& layout = transport.layout();
  for (std::size_t entry = 0; entry < leaves.blocks(); ++entry)
    connections += static_cast<std::uint64_t>(layout.block(layout.node(leaves.column(entry))).count());
  return connections;
}

/// A figure that a stage cost.
double costOf(const CalibrationFolder& folder, const char* stageName, const char* figure) {
  std::optional<StageResult> stored = folder.latest(stageName);
  if (!stored || !stored->values.contains("cost")) return 0.0;
  return stored->values["cost"].value(figure, 0.0);
}

}  // namespace

CalibrateResult summaryOf(const CalibrationFolder& folder, const MeasuredCalibration& measured) {
  CalibrateResult result;
  for (const char* stageName : {stage::linearization, stage::acquisition}) {
    result.patterns += static_cast<int>(costOf(folder, stageName, "patterns"));
    result.exposures += static_cast<int>(costOf(folder, stageName, "exposures"));
  }
  result.seconds.linearization = costOf(folder, stage::linearization, "seconds");
  result.seconds.acquisition = costOf(folder, stage::acquisition, "seconds");
  result.seconds.inverse = costOf(folder, stage::inverse, "seconds");
  const Acquisition& acquisition = measured.acquisition;
  result.leaves = measured.venue.transport.leaves().blocks();
  result.connections = connectionsOf(measured.venue.transport);
  result.unresolvedEnergy = acquisition.unresolvedEnergy;
  result.verificationError = acquisition.verificationError;
  auto flagged = static_cast<double>(
      acquisition.flagged.size() -
      static_cast<std::size_t>(std::count(acquisition.flagged.begin(), acquisition.flagged.end(), 0)));
  result.flaggedShare = flagged / static_cast<double>(acquisition.flagged.size());
  result.findings = measured.linearization.findings;
  result.findings.insert(result.findings.end(), acquisition.findings.begin(), acquisition.findings.end());
  return result;
}

MeasuredVenue loadMeasuredVenue(const CalibrationFolder& folder, Progress& progress) {
  return loadMeasurements(folder, progress).venue;
}

RidgeChoice invert(const MeasuredVenue& venue, const CalibrateSettings& settings, Progress& progress) {
  if (settings.chooseRidge) return chooseRidge(venue, settings.windows, progress);
  return {
      settings.windows.ridge, {}, computeWindows(venue.transport, venue.usable, settings.windows, progress)};
}

MeasuredCalibration loadCalibration(const CalibrationFolder& folder, Progress& progress) {
  Progress reading = progress.part(0.5, "Reading the calibration");
  MeasuredCalibration measured = loadMeasurements(folder, reading);
  Progress inverting = progress.part(0.5, "Inverting the light transport");
  CalibrateSettings settings = settingsOf(folder);
  // Which ridge is best has been tried already, unless an older version made the calibration.
  if (auto done = folder.find(stage::inverse, inverseFingerprint(folder))) {
    settings.windows.ridge = done->values.value("ridge", settings.windows.ridge);
    settings.chooseRidge = false;
    for (const Json& trial : done->values.value("curve", Json::array()))
      measured.ridgeCurve.push_back({trial.value("ridge", 0.0), trial.value("psnr", 0.0)});
  }
  RidgeChoice choice = invert(measured.venue, settings, inverting);
  measured.ridge = choice.ridge;
  measured.inverse = std::move(choice.inverse);
  if (measured.ridgeCurve.empty()) measured.ridgeCurve = std::move(choice.curve);
  return measured;
}

}  // namespace relucent
