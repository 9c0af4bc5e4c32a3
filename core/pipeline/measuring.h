// SPDX-License-Identifier: MIT
#pragma once

#include "calibration/calibration_folder.h"
#include "linearization/linearization.h"
#include "pipeline/calibrate_settings.h"
#include "pipeline/measured_venue.h"
#include "rig/rig.h"
#include "sentinels/observer.h"

/// The stages of calibrate() one by one, for whoever looks at each result before the next is begun. Every one
/// takes its settings from the folder, is read from there where it is done already, and goes on where an
/// interrupted run stopped.
namespace relucent {

/// A new calibration in which nothing has been measured.
/// Throws: Error{input} for settings with problems(); as CalibrationFolder::create().
CalibrationFolder beginCalibration(const std::filesystem::path& path, const CalibrateSettings& settings);

/// Throws: as linearize() and storeLinearization().
Linearization measureLinearization(CalibrationFolder& folder, Rig& rig, Progress& progress);
/// Throws: as acquire() and storeAcquisition().
Acquisition measureAcquisition(CalibrationFolder& folder, Rig& rig, const Linearization& linearization,
                               const AlarmHandler& handler, Progress& progress);
/// The same with somebody who looks on.
Acquisition measureAcquisition(CalibrationFolder& folder, Rig& rig, const Linearization& linearization,
                               const AlarmHandler& handler, AcquisitionObserver& observer,
                               Progress& progress);
/// Chooses the windows' ridge and keeps it, unless that is done. Throws: as invert(); Error{disk}.
void measureInverse(CalibrationFolder& folder, const MeasuredVenue& venue, Progress& progress);

/// Takes a stage's photographs out of the journal into a folder beside it, so that running the stage again
/// measures anew. Its results stay. Throws: Error{disk}.
void setShotsAside(const CalibrationFolder& folder, Stage stage);

}  // namespace relucent
