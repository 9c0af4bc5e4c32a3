// SPDX-License-Identifier: MIT
#include "relucent/pipeline/acquisition_bench.h"

#include <fmt/format.h>

#include <algorithm>

#include "relucent/devices/temporary_folder.h"
#include "relucent/pipeline/calibrate.h"
#include "relucent/pipeline/devices.h"
#include "relucent/pipeline/evaluate.h"
#include "relucent/pipeline/measured_venue.h"
#include "relucent/pipeline/measuring.h"

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

CalibrateSettings trialSettings(const venue::VenueSettings& venue, const Trial& trial) {
  CalibrateSettings settings;
  settings.rig = venue;
  settings.acquisition = acquisition::settingsOf(trial.mode);
  settings.acquisition.seed = venue.seed;
  settings.acquisition.relativeThreshold = trial.threshold;
  settings.acquisition.colours = trial.colours;
  return settings;
}

AcquisitionBenchRun measured(const venue::VenueSettings& venue, const Trial& trial,
                             const std::filesystem::path& cache, Progress& progress) {
  devices::TemporaryFolder temporary;
  std::filesystem::path path = temporary.path() / venue.name;
  Progress calibrating = progress.part(0.9, progress.stage());
  CalibrateResult spent = calibrate(path, trialSettings(venue, trial), cache, calibrating);

  Progress judging = progress.part(0.1, progress.stage());
  EvaluateSettings judged;
  judged.target = compensation::TargetSettings::ofLight();
  judged.fewImages = true;
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

/// Asks to stop and keep when a number of levels are measured.
class Stopping : public sentinels::AcquisitionObserver {
 public:
  Stopping(int levels, StopRequest& stop) : levels_(levels), stop_(stop) {}
  void grew(const std::vector<int>& levels, int) override {
    if (std::ssize(levels) == levels_) stop_.ask(StopRequest::Kind::keep);
  }

 private:
  int levels_;
  StopRequest& stop_;
};

/// Measures until a number of levels, and compensates with that. Photographs of the time before are not taken
/// again. None: blocks as wide as these hold no picture.
std::optional<AcquisitionBenchStop> stopped(const std::filesystem::path& path, int levels,
                                            const venue::VenueSettings& venue,
                                            const std::filesystem::path& cache) {
  struct Nobody : ProgressSink {
    void progressed(double, const Message&) override {}
  } nobody;
  StopRequest stop;
  Stopping observer(levels, stop);
  Progress measuring(nobody, stop), quiet;
  AcquisitionBenchStop result;
  result.venue = venue.name;
  {
    calibration::CalibrationFolder folder =
        calibration::CalibrationFolder::open(path, calibration::CalibrationFolder::Access::write);
    OpenedRig devices = openRig(venue, cache, quiet);
    const linearization::Linearization linearization = measureLinearization(folder, devices.rig, quiet);
    const transport::Acquisition acquisition =
        goOnMeasuring(folder, devices.rig, linearization, {}, observer, {}, measuring);
    result.blocks = acquisition.stoppedAt;
    result.patterns = acquisition.patterns;
    if (!acquisition.expected) return std::nullopt;
    result.expected = *acquisition.expected;
    measureInverse(folder, measuredVenueOf(acquisition, {}), quiet);
  }
  EvaluateSettings judged;
  judged.target = compensation::TargetSettings::ofLight();
  judged.fewImages = true;
  judged.methods = {compensation::Method::refined};
  result.refined = meanPsnr(evaluate(path, judged, cache, quiet), compensation::Method::refined);
  return result;
}

/// After each level, and in the end.
std::vector<AcquisitionBenchStop> stops(const venue::VenueSettings& venue, const Trial& trial,
                                        const std::filesystem::path& cache, Progress& progress) {
  devices::TemporaryFolder temporary;
  std::filesystem::path path = temporary.path() / venue.name;
  beginCalibration(path, trialSettings(venue, trial));
  std::vector<AcquisitionBenchStop> found;
  const int most = transport::NodeLayout(venue.projector).levels() + 1;
  for (int levels = 1; levels <= most && (found.empty() || found.back().blocks != 0); ++levels) {
    progress.checkpoint();
    std::optional<AcquisitionBenchStop> stop = stopped(path, levels, venue, cache);
    if (!stop) continue;
    found.push_back(*std::move(stop));
    found.back().threshold = trial.threshold;
  }
  return found;
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
    if ((!settings.everyLevel || trial.mode == acquisition::AcquisitionMode::multiplexed) &&
        among(settings.modes, trial.mode) && among(settings.thresholds, trial.threshold))
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
  AcquisitionBenchResult result{settings.projector, settings.camera, {}, {}};
  std::vector<std::string> names = venueNames(settings);
  std::vector<Trial> chosen = trialsOf(settings);
  double share = 1.0 / static_cast<double>(names.size() * chosen.size());
  for (const std::string& name : names) {
    venue::VenueSettings venue;
    venue.name = name;
    venue.projector = settings.projector;
    venue.camera = settings.camera;
    venue.seed = settings.seed;
    for (const Trial& trial : chosen) {
      Progress part =
          progress.part(share, RELUCENT_ENGLISH_MESSAGE("stage.venue-mode-threshold", "{}: {} at {}")
                                   .with(name, nameOf(trial.mode), trial.threshold));
      if (!settings.everyLevel) {
        result.runs.push_back(measured(venue, trial, cache, part));
        continue;
      }
      for (AcquisitionBenchStop& stop : stops(venue, trial, cache, part)) result.stops.push_back(stop);
    }
  }
  progress.report(1.0);
  return result;
}

}  // namespace relucent::pipeline
