// SPDX-License-Identifier: MIT
#include "relucent/pipeline/scale_bench.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "relucent/acquisition/forecast.h"
#include "relucent/base/stopwatch.h"
#include "relucent/devices/temporary_folder.h"
#include "relucent/image/colour.h"
#include "relucent/image/picture_files.h"
#include "relucent/pipeline/compensate.h"
#include "relucent/pipeline/devices.h"
#include "relucent/pipeline/evaluate.h"
#include "relucent/pipeline/measured_venue.h"
#include "relucent/pipeline/measuring.h"
#include "relucent/pipeline/reductions.h"
#include "relucent/pipeline/standard_images.h"
#include "relucent/platform/memory_peak.h"
#include "relucent/platform/process.h"

namespace relucent::pipeline {
namespace fs = std::filesystem;
namespace {

venue::VenueSettings venueOf(const ScaleBenchSettings& settings, const VenueSizes& sizes) {
  venue::VenueSettings venue;
  venue.name = settings.venue;
  venue.projector = sizes.projector;
  venue.camera = sizes.camera;
  venue.seed = settings.seed;
  venue.pathsPerPixel = settings.pathsPerPixel;
  return venue;
}

std::uint64_t bytesIn(const fs::path& folder) {
  std::uint64_t bytes = 0;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) bytes += entry.file_size();
  return bytes;
}

/// Seconds since a folder last got a photograph of a stage.
double sinceLastPhotograph(const fs::path& shots) {
  fs::file_time_type last = fs::file_time_type::min();
  for (const fs::directory_entry& entry : fs::directory_iterator(shots))
    last = std::max(last, entry.last_write_time());
  return std::chrono::duration<double>(fs::file_time_type::clock::now() - last).count();
}

/// One size, stage after stage in a folder of its own.
class Measurement {
 public:
  Measurement(const ScaleBenchSettings& settings, const VenueSizes& sizes, const fs::path& cache)
      : settings_(settings), cache_(cache), calibration_(temporary_.path() / "calibration") {
    run_.sizes = sizes;
  }

  ScaleBenchRun run(Progress& progress) {
    const fs::path picture = temporary_.path() / "content.png";
    image::writePng(picture, image::srgbEncoded(standardImages().front().linear), 16);
    measure(progress);
    stage("still", 0.05, progress, [&](Progress& part) {
      CompensateSettings still;
      still.image = picture;
      still.out = temporary_.path() / "still";
      compensate(calibration_, still, part);
    });
    run_.secondsToStill = sinceLastPhotograph(calibration_ / "shots");
    stage("evaluation", 0.15, progress, [&](Progress& part) { judge(part); });
    for (const ScaleBenchSettings::Stage& after : settings_.after)
      stage(after.name, 0.05, progress,
            [&](Progress& part) { after.run(calibration_, temporary_.path() / after.name, part); });
    run_.photographBytes = bytesIn(calibration_ / "shots");
    run_.resultBytes = bytesIn(calibration_ / "results");
    return std::move(run_);
  }

 private:
  template <typename Work>
  void stage(const std::string& name, double share, Progress& progress, const Work& work) {
    Progress part =
        progress.part(share, Message::plain(fmt::format("{}x{} / {}x{}: {}", run_.sizes.projector.width,
                                                        run_.sizes.projector.height, run_.sizes.camera.width,
                                                        run_.sizes.camera.height, name)));
    platform::MemoryPeak peak;
    const double before = platform::processorSeconds();
    Stopwatch watch;
    work(part);
    const platform::MemoryUse most = peak.value();
    run_.stages.push_back(
        {name, watch.seconds(), most.resident, most.ofFiles, platform::processorSeconds() - before});
  }

  /// As calibrate() does it.
  void measure(Progress& progress) {
    CalibrateSettings settings;
    settings.rig = venueOf(settings_, run_.sizes);
    settings.acquisition.seed = settings.linearization.seed = settings_.seed;
    OpenedRig devices;
    stage("venue", 0.3, progress, [&](Progress& part) { devices = openRig(settings.rig, cache_, part); });
    calibration::CalibrationFolder folder = beginCalibration(calibration_, settings);
    linearization::Linearization linearization;
    stage("linearization", 0.05, progress,
          [&](Progress& part) { linearization = measureLinearization(folder, devices.rig, part); });
    const rig::Rig used = reducedRig(folder, devices.rig);
    run_.used = used.cameraRasters().size(0);
    run_.forecastBytes = acquisition::forecast(acquisition::forecastDevices(used, linearization.exposures),
                                               settings.acquisition, linearization.times, {})
                             .memoryBytes;
    MeasuredCalibration measured;
    stage("acquisition", 0.3, progress, [&](Progress& part) {
      sentinels::AcquisitionObserver nobody;
      const transport::Acquisition acquisition =
          goOnMeasuring(folder, devices.rig, linearization, {}, nobody, {}, part);
      measured.acquisition = figuresOf(acquisition);
      measured.venue = measuredVenueOf(acquisition, settings.threshold);
    });
    stage("inverse", 0.1, progress, [&](Progress& part) { measureInverse(folder, measured.venue, part); });
    const CalibrateResult summary = summaryOf(folder, measured);
    run_.exposures = summary.exposures;
    run_.leaves = summary.leaves;
  }

  void judge(Progress& progress) {
    EvaluateSettings judged;
    judged.target = compensation::TargetSettings::ofLight();
    judged.fewImages = true;
    judged.methods = {compensation::Method::windows, compensation::Method::refined};
    const EvaluateResult result = evaluate(calibration_, judged, cache_, progress);
    run_.windows = meanPsnr(result, compensation::Method::windows);
    run_.refined = meanPsnr(result, compensation::Method::refined);
  }

  const ScaleBenchSettings& settings_;
  const fs::path& cache_;
  const devices::TemporaryFolder temporary_;
  const fs::path calibration_;
  ScaleBenchRun run_;
};

double pixelsOf(const ScaleBenchRun& run) {
  return static_cast<double>(run.sizes.projector.count() + run.sizes.camera.count());
}

}  // namespace

std::vector<Message> problems(const ScaleBenchSettings& settings) {
  std::vector<Message> found;
  for (const VenueSizes& sizes : settings.sizes)
    for (Message& problem : problems(venueOf(settings, sizes))) found.push_back(std::move(problem));
  return found;
}

std::vector<double> growthOf(const ScaleBenchRun& before, const ScaleBenchRun& after) {
  std::vector<double> growth;
  for (const ScaleStage& stage : after.stages) {
    const auto same = std::ranges::find(before.stages, stage.name, &ScaleStage::name);
    growth.push_back(same == before.stages.end() ? std::numeric_limits<double>::quiet_NaN()
                                                 : std::log(stage.seconds / same->seconds) /
                                                       std::log(pixelsOf(after) / pixelsOf(before)));
  }
  return growth;
}

ScaleBenchResult benchScale(const ScaleBenchSettings& settings, const fs::path& cache, Progress& progress) {
  ScaleBenchResult result{settings.venue, {}};
  double all = 0.0;
  for (const VenueSizes& sizes : settings.sizes)
    all += static_cast<double>(sizes.projector.count() + sizes.camera.count());
  for (const VenueSizes& sizes : settings.sizes) {
    const double pixels = static_cast<double>(sizes.projector.count() + sizes.camera.count());
    Progress part = progress.part(pixels / all, progress.stage());
    result.runs.push_back(Measurement(settings, sizes, cache).run(part));
  }
  progress.report(1.0);
  return result;
}

}  // namespace relucent::pipeline
