// SPDX-License-Identifier: MIT
#include "wizard/session/results_beside.h"

#include <algorithm>
#include <array>

#include "relucent/base/error.h"
#include "relucent/base/file.h"
#include "relucent/base/message.h"
#include "relucent/calibration/calibration_folder.h"
#include "relucent/calibration/stage_fingerprint.h"
#include "relucent/pipeline/measured_again.h"

namespace relucent::gui {
namespace {

using calibration::CalibrationFolder;
using calibration::Stage;

// In their order: the later one's inputs include the earlier one's.
constexpr std::array measuredStages{Stage::linearization, Stage::acquisition};

}  // namespace

bool ResultsBeside::areNeeded(const Session& session) {
  return session.isMeasuring() || std::ranges::any_of(measuredStages, [&session](Stage stage) {
           return session.mayReturnToEarlier(stage) ||
                  session.progress(stage) == calibration::StageProgress::stale;
         });
}

ResultsBeside::ResultsBeside(const std::filesystem::path& calibration) {
  writeFileAtomically(path() / CalibrationFolder::manifestName,
                      readFile(calibration / CalibrationFolder::manifestName));
  {
    // Before there is a way to the results: who opens a calibration for writing clears away what is half
    // written.
    CalibrationFolder folder = CalibrationFolder::open(path(), CalibrationFolder::Access::write);
    for (Stage stage : measuredStages) {
      if (pipeline::mayReturnToEarlier(folder, stage)) pipeline::returnToEarlier(folder, stage);
      // Of other settings than those of now: it is what there is until it is measured with these.
      if (const std::string inputs = calibration::fingerprintOf(folder, stage);
          !folder.isCurrent(stage, inputs))
        folder.takeAsCurrent(stage, inputs);
    }
  }
  std::error_code code;
  std::filesystem::create_directory_symlink(calibration / "results", path() / "results", code);
  if (code)
    throw Error(ErrorKind::disk,
                RELUCENT_MESSAGE("disk.cannot-write", "cannot write ({})").with(code.message()),
                RELUCENT_MESSAGE("disk.free-space-or-check-disk",
                                 "free some space there or check the disk, then try again"),
                path().string());
}

}  // namespace relucent::gui
