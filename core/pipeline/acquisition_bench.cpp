// SPDX-License-Identifier: MIT
#include "relucent/pipeline/acquisition_bench.h"

#include <fmt/format.h>

#include <algorithm>

#include "relucent/devices/temporary_folder.h"
#include "relucent/pipeline/calibrate.h"
#include "relucent/pipeline/evaluate.h"

namespace relucent::pipeline {
namespace {

struct Trial {
  acquisition::AcquisitionMode mode;
  double threshold;
  acquisition::LitColours colours = acquisition::LitColours::rgb;
};
// sen spends several times the patterns at the same threshold, so that it is tried at looser ones too.
constexpr Trial trials[] = {{acquisition::AcquisitionMode::adaptive, 0.006},
                            {acquisition::AcquisitionMode::adaptive, 0.008},
                            {acquisition::AcquisitionMode::adaptive, 0.02},
                            {acquisition::AcquisitionMode::adaptive, 0.02, acquisition::LitColours::white},
                            {acquisition::AcquisitionMode::sen, 0.008},
                            {acquisition::AcquisitionMode::sen, 0.02},
                            {acquisition::AcquisitionMode::sen, 0.05},
                            {acquisition::AcquisitionMode::fast, 0.02, acquisition::LitColours::white},
                            {acquisition::AcquisitionMode::multiplexed, 0.03},
                            {acquisition::AcquisitionMode::multiplexed, 0.012},
                            {acquisition::AcquisitionMode::multiplexed, 0.006}};

double meanPsnr(const EvaluateResult& result, compensation::Method method) {
  double sum = 0.0;
  for (const ImageScore& image : result.images)
    for (const MethodScore& score : image.methods)
      if (score.method == method) sum += score.psnrReachable;
  return sum / static_cast<double>(result.images.size());
}

AcquisitionBenchRun measured(const venue::VenueSettings& venue, const Trial& trial,
                             const std::filesystem::path& cache, Progress& progress) {
  devices::TemporaryFolder temporary;
  std::filesystem::path path = temporary.path() / venue.name;
  CalibrateSettings settings;
  settings.rig = venue;
  settings.acquisition = settingsOf(trial.mode);
  settings.acquisition.relativeThreshold = trial.threshold;
  settings.acquisition.colours = trial.colours;
  Progress calibrating = progress.part(0.9, progress.stage());
  CalibrateResult spent = calibrate(path, settings, cache, calibrating);

  Progress judging = progress.part(0.1, progress.stage());
  EvaluateSettings judged;
  judged.methods = {compensation::Method::windows, compensation::Method::refined};
  EvaluateResult result = evaluate(path, judged, cache, judging);
  return {.venue = venue.name,
          .mode = trial.mode,
          .threshold = trial.threshold,
          .colours = trial.colours,
          .patterns = spent.patterns,
          .exposures = spent.exposures,
          .linearization = spent.linearizationExposures,
          .seconds = spent.seconds.acquisition,
          .unresolvedEnergy = spent.unresolvedEnergy,
          .transport = result.transport,
          .windows = meanPsnr(result, compensation::Method::windows),
          .refined = meanPsnr(result, compensation::Method::refined)};
}

std::vector<std::string> venueNames(const AcquisitionBenchSettings& settings) {
  if (!settings.venues.empty()) return settings.venues;
  std::vector<std::string> names;
  for (const venue::VenueDescription& venue : venue::venues()) names.push_back(venue.name);
  return names;
}

template <class Wanted, class Value>
bool among(const std::vector<Wanted>& wanted, const Value& value) {
  return wanted.empty() || std::find(wanted.begin(), wanted.end(), value) != wanted.end();
}

std::vector<Trial> trialsOf(const AcquisitionBenchSettings& settings) {
  std::vector<Trial> chosen;
  for (const Trial& trial : trials)
    if (among(settings.modes, trial.mode) && among(settings.thresholds, trial.threshold))
      chosen.push_back(trial);
  return chosen;
}

}  // namespace

std::vector<Message> problems(const AcquisitionBenchSettings& settings) {
  std::vector<Message> found;
  for (const std::string& name : venueNames(settings)) {
    venue::VenueSettings venue;
    venue.name = name;
    venue.projector = settings.projector;
    venue.camera = settings.camera;
    CalibrateSettings one;
    one.rig = venue;
    for (Message& problem : problems(one)) found.push_back(std::move(problem));
  }
  if (trialsOf(settings).empty())
    found.push_back(RELUCENT_ENGLISH_MESSAGE(
        "bench.no-matching-trial",
        "nothing is measured in that mode at that threshold; leave both out to compare all"));
  return found;
}

AcquisitionBenchResult benchAcquisition(const AcquisitionBenchSettings& settings,
                                        const std::filesystem::path& cache, Progress& progress) {
  AcquisitionBenchResult result{settings.projector, settings.camera, {}};
  std::vector<std::string> names = venueNames(settings);
  std::vector<Trial> chosen = trialsOf(settings);
  double share = 1.0 / static_cast<double>(names.size() * chosen.size());
  for (const std::string& name : names) {
    venue::VenueSettings venue;
    venue.name = name;
    venue.projector = settings.projector;
    venue.camera = settings.camera;
    for (const Trial& trial : chosen) {
      Progress part =
          progress.part(share, RELUCENT_ENGLISH_MESSAGE("stage.venue-mode-threshold", "{}: {} at {}")
                                   .with(name, nameOf(trial.mode), trial.threshold));
      result.runs.push_back(measured(venue, trial, cache, part));
    }
  }
  progress.report(1.0);
  return result;
}

}  // namespace relucent::pipeline
