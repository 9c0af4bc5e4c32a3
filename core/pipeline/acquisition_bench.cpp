// SPDX-License-Identifier: MIT
#include "pipeline/acquisition_bench.h"

#include <fmt/format.h>

#include <algorithm>

#include "devices/temporary_folder.h"
#include "pipeline/evaluation.h"

namespace relucent {
namespace {

struct Trial {
  const char* mode;
  double threshold;
};
// sen spends several times the patterns at the same threshold, so that it is tried at looser ones too.
constexpr Trial trials[] = {{"adaptive", 0.006}, {"adaptive", 0.008}, {"adaptive", 0.02}, {"sen", 0.008},
                            {"sen", 0.02},       {"sen", 0.05},       {"fast", 0.02}};

AcquisitionRun measured(const VenueSettings& venue, const Trial& trial, const std::filesystem::path& cache,
                        Progress& progress) {
  TemporaryFolder temporary;
  std::filesystem::path path = temporary.path() / venue.name;
  CalibrateSettings settings;
  settings.rig = venue;
  settings.acquisition = acquisitionMode(trial.mode);
  settings.acquisition.relativeThreshold = trial.threshold;
  settings.chooseRidge = false;  // only T is judged
  Progress calibrating = progress.part(0.9, progress.stage());
  CalibrateResult spent = calibrate(path, settings, cache, calibrating);

  CalibrationFolder folder = CalibrationFolder::open(path, CalibrationFolder::Access::read);
  Progress judging = progress.part(0.1, progress.stage());
  TransportScore score = transportScore(loadCalibration(folder, judging), cache, judging);
  return {venue.name,
          trial.mode,
          trial.threshold,
          spent.patterns,
          spent.exposures,
          spent.seconds.acquisition,
          spent.unresolvedEnergy,
          score};
}

std::vector<std::string> venueNames(const AcquisitionBenchSettings& settings) {
  if (!settings.venues.empty()) return settings.venues;
  std::vector<std::string> names;
  for (const VenueDescription& venue : venues()) names.push_back(venue.name);
  return names;
}

}  // namespace

std::vector<std::string> problems(const AcquisitionBenchSettings& settings) {
  std::vector<std::string> found;
  for (const std::string& name : venueNames(settings)) {
    CalibrateSettings one;
    VenueSettings venue;
    venue.name = name;
    venue.projector = settings.projector;
    venue.camera = settings.camera;
    one.rig = venue;
    for (std::string& problem : problems(one)) found.push_back(std::move(problem));
  }
  return found;
}

AcquisitionBenchResult benchAcquisition(const AcquisitionBenchSettings& settings,
                                        const std::filesystem::path& cache, Progress& progress) {
  AcquisitionBenchResult result{settings.projector, settings.camera, {}};
  std::vector<std::string> names = venueNames(settings);
  double share = 1.0 / static_cast<double>(names.size() * std::size(trials));
  for (const std::string& name : names) {
    VenueSettings venue;
    venue.name = name;
    venue.projector = settings.projector;
    venue.camera = settings.camera;
    for (const Trial& trial : trials) {
      Progress part = progress.part(share, fmt::format("{}: {} at {}", name, trial.mode, trial.threshold));
      result.runs.push_back(measured(venue, trial, cache, part));
    }
  }
  progress.report(1.0);
  return result;
}

}  // namespace relucent
