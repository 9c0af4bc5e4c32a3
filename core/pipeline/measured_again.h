// SPDX-License-Identifier: MIT
#pragma once

#include "relucent/calibration/calibration_folder.h"
#include "relucent/calibration/stage_progress.h"

/// Measuring a stage again that has a result, and back to that result. Of linearization and acquisition.
namespace relucent::pipeline {

/// Takes a stage's photographs out of the journal into a folder beside it, so that running the stage again
/// measures again. Its results stay. Throws: Error{disk}.
void setShotsAside(const calibration::CalibrationFolder& folder, calibration::Stage stage);

/// The stage is to be measured again: with other patterns of the same kind, another seed, and without the
/// photographs that there are, which are set aside. Its result stays, out of date, until there is a new one.
/// Throws: Error{disk}.
void measureAgain(calibration::CalibrationFolder& folder, calibration::Stage stage);

/// Whether there is a result from before measureAgain() to go back to.
bool hasEarlier(const calibration::CalibrationFolder& folder, calibration::Stage stage);

/// Whether there is, and measuring again has no result yet.
bool mayReturnToEarlier(const calibration::CalibrationFolder& folder, calibration::Stage stage);

/// Where a stage stands while `again`, before it, may have been measured again: done, too, where it follows
/// from the result that is used until there is a new one.
calibration::StageProgress progressInUse(const calibration::CalibrationFolder& folder,
                                         calibration::Stage stage, calibration::Stage again);

/// Takes measureAgain() back: the earlier result is current again, and what followed from it, and its
/// photographs, where they are kept, are in the journal. The new ones are set aside. Nothing where
/// !hasEarlier().
/// Throws: Error{disk}.
void returnToEarlier(calibration::CalibrationFolder& folder, calibration::Stage stage);

}  // namespace relucent::pipeline
