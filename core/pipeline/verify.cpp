// SPDX-License-Identifier: MIT
#include "pipeline/verify.h"

#include "base/error.h"
#include "base/file.h"
#include "base/stopwatch.h"
#include "calibration/results.h"
#include "calibration/stage_progress.h"
#include "image/stack_files.h"
#include "pipeline/devices.h"
#include "pipeline/stored_settings.h"

namespace relucent {
namespace fs = std::filesystem;
namespace {

std::vector<fs::path> writeMaps(const fs::path& folder, const Reverification& found, const Rasters& cameras) {
  createFolder(folder);
  std::vector<fs::path> files;
  auto write = [&](const std::string& name, const Stack& stack, const std::string& units) {
    for (fs::path& file : writeStack(folder, name, stack, cameras, units)) files.push_back(std::move(file));
  };
  for (std::size_t size = 0; size < found.residual.size(); ++size)
    write(fmt::format("residual-{}", 1 << size), found.residual[size], "camera signal per second");
  write("changed", stackFromFlags(found.changed), "1 where a pixel sees something else than predicted");
  return files;
}

VerifyResult verified(const fs::path& path, const VerifySettings& settings, RigSource source,
                      Progress& progress) {
  if (std::vector<Message> found = problems(settings); !found.empty())
    throw Error(ErrorKind::input, found.front(),
                RELUCENT_ENGLISH_MESSAGE("calibration.change-setting-start-again",
                                         "change that setting and start again"));
  CalibrationFolder folder = CalibrationFolder::open(path, CalibrationFolder::Access::read);
  CalibrateSettings calibrated = settingsOf(folder);
  auto linearized = currentResultOf(folder, Stage::linearization);
  auto acquired = currentResultOf(folder, Stage::acquisition);
  if (!linearized || !acquired)
    throw Error(
        ErrorKind::input,
        RELUCENT_ENGLISH_MESSAGE("calibration.calibration-not-finished", "the calibration is not finished"),
        RELUCENT_ENGLISH_MESSAGE("calibration.finish-first-relucent-cli-resume",
                                 "finish it first: relucent-cli resume {}")
            .with(path.string()),
        path.string());
  Linearization linearization = loadLinearization(*linearized);
  Acquisition acquisition = loadAcquisition(*acquired);
  progress.report(0.2);

  Progress opening = progress.part(0.2, RELUCENT_MESSAGE("stage.preparing-devices", "Preparing the devices"));
  Rig& rig = source.open(settings.rig.value_or(calibrated.rig), acquisition.transport, path, opening);

  Progress verifying = progress.part(
      0.6, RELUCENT_MESSAGE("stage.photographing-test-patterns", "Photographing test patterns"));
  Stopwatch watch;
  NoShotLog log;
  ShotTaker shots(rig, log, "verify");
  VerifyResult result;
  result.errorThen = acquisition.verificationError;
  result.found = verifyAgain({shots, linearization, calibrated.acquisition}, acquisition, verifying);
  result.judgement = judge(result.found, result.errorThen);
  result.seconds = watch.seconds();
  if (!settings.out.empty())
    result.files = writeMaps(settings.out, result.found, acquisition.transport.cameras());
  progress.report(1.0);
  return result;
}

}  // namespace

VerifyResult verifyCalibration(const fs::path& path, const VerifySettings& settings, const fs::path& cache,
                               Progress& progress) {
  return verified(path, settings, RigSource(cache), progress);
}

VerifyResult verifyCalibration(const fs::path& path, const VerifySettings& settings, Rig& rig,
                               Progress& progress) {
  return verified(path, settings, RigSource(rig), progress);
}

}  // namespace relucent
