// SPDX-License-Identifier: MIT
#include "relucent/pipeline/verify.h"

#include "relucent/base/error.h"
#include "relucent/base/file.h"
#include "relucent/base/stopwatch.h"
#include "relucent/calibration/results.h"
#include "relucent/calibration/stage_progress.h"
#include "relucent/image/stack_files.h"
#include "relucent/pipeline/devices.h"
#include "relucent/pipeline/not_finished.h"
#include "relucent/pipeline/stored_settings.h"

namespace relucent::pipeline {
namespace fs = std::filesystem;
namespace {

std::vector<fs::path> writeMaps(const fs::path& folder, const acquisition::Reverification& found,
                                const Rasters& cameras) {
  createFolder(folder);
  std::vector<fs::path> files;
  auto write = [&](const std::string& name, const Stack& stack, const std::string& units,
                   image::ExrPacking packing) {
    for (fs::path& file : image::writeStack(folder, name, stack, cameras, units, packing))
      files.push_back(std::move(file));
  };
  for (std::size_t size = 0; size < found.residual.size(); ++size)
    write(fmt::format("residual-{}", 1 << size), found.residual[size], "camera signal per second",
          image::ExrPacking::none);
  write("changed", image::stackFromFlags(found.changed), "1 where a pixel sees something else than predicted",
        image::ExrPacking::zip);
  return files;
}

VerifyResult verified(const fs::path& path, const VerifySettings& settings, RigSource source,
                      Progress& progress) {
  if (std::vector<Message> found = problems(settings); !found.empty())
    throw Error(
        ErrorKind::input, found.front(),
        RELUCENT_ENGLISH_MESSAGE("settings.change-and-start-again", "change that setting and start again"));
  calibration::CalibrationFolder folder =
      calibration::CalibrationFolder::open(path, calibration::CalibrationFolder::Access::read);
  CalibrateSettings calibrated = settingsOf(folder);
  auto linearized = calibration::resultOf(folder, calibration::Stage::linearization);
  auto acquired = calibration::resultOf(folder, calibration::Stage::acquisition);
  if (!linearized || !acquired) throw notFinished(path);
  linearization::Linearization linearization = calibration::loadLinearization(*linearized);
  transport::Acquisition acquisition = calibration::loadAcquisition(*acquired);
  progress.report(0.2);

  Progress opening = progress.part(0.2, RELUCENT_MESSAGE("stage.preparing-devices", "Preparing the devices"));
  rig::Rig& rig = source.open(settings.rig.value_or(calibrated.rig), acquisition.transport, folder, opening);

  Progress verifying = progress.part(
      0.6, RELUCENT_MESSAGE("stage.photographing-test-patterns", "Photographing test patterns"));
  Stopwatch watch;
  rig::NoShotLog log;
  rig::ShotTaker shots(rig, log, "verify");
  VerifyResult result;
  result.errorThen = acquisition.verificationError;
  result.found =
      acquisition::verifyAgain({shots, linearization, calibrated.acquisition}, acquisition, verifying);
  result.judgement = acquisition::judge(result.found, result.errorThen);
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

VerifyResult verifyCalibration(const fs::path& path, const VerifySettings& settings, rig::Rig& rig,
                               Progress& progress) {
  return verified(path, settings, RigSource(rig), progress);
}

}  // namespace relucent::pipeline
