// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

#include "relucent/calibration/calibration_folder.h"
#include "relucent/calibration/room_on_disk.h"
#include "relucent/linearization/linearization.h"
#include "relucent/pipeline/calibrate_settings.h"
#include "relucent/pipeline/measured_venue.h"
#include "relucent/pipeline/outlook_observer.h"
#include "relucent/rig/rig.h"
#include "relucent/sentinels/observer.h"

/// The stages of calibrate() one by one, for whoever looks at each result before the next is begun. Every one
/// takes its settings from the folder, is read from there where it is done already, and goes on where an
/// interrupted run stopped.
namespace relucent::pipeline {

/// A new calibration in which nothing has been measured.
/// Throws: Error{input} for settings with problems(); as CalibrationFolder::create().
calibration::CalibrationFolder beginCalibration(const std::filesystem::path& path,
                                                const CalibrateSettings& settings);

/// `rig`: the devices as they are; what of the cameras is used is chosen first, see reductions.h.
/// Throws: as linearize(), chooseReductions(), reduced() and storeLinearization().
linearization::Linearization measureLinearization(calibration::CalibrationFolder& folder, rig::Rig& rig,
                                                  Progress& progress);
/// The same with somebody who waits where the disk is full; null: nobody, that is an Error{disk}.
linearization::Linearization measureLinearization(calibration::CalibrationFolder& folder, rig::Rig& rig,
                                                  calibration::RoomWaiter* room, Progress& progress);
/// Throws: as acquire(), reduced() and storeAcquisition().
transport::Acquisition measureAcquisition(calibration::CalibrationFolder& folder, rig::Rig& rig,
                                          const linearization::Linearization& linearization,
                                          const sentinels::AlarmHandler& handler, Progress& progress);
/// The same with somebody who looks on.
transport::Acquisition measureAcquisition(calibration::CalibrationFolder& folder, rig::Rig& rig,
                                          const linearization::Linearization& linearization,
                                          const sentinels::AlarmHandler& handler,
                                          sentinels::AcquisitionObserver& observer, Progress& progress);
/// Goes on with a measurement that was stopped and kept, as if it had not been; another is as above. Until it
/// is finished, what was kept stays the result. `outlook` is told, from other threads, what may be expected
/// as it gets finer; what was expected last is kept with the result. Photographs that the calibration's
/// choice does not keep (kept_photographs.h) are removed once nothing is left to measure.
transport::Acquisition goOnMeasuring(calibration::CalibrationFolder& folder, rig::Rig& rig,
                                     const linearization::Linearization& linearization,
                                     const sentinels::AlarmHandler& handler,
                                     sentinels::AcquisitionObserver& observer,
                                     const OutlookObserver::Tell& outlook, Progress& progress);
/// The same with somebody who waits where the disk is full; null: nobody.
transport::Acquisition goOnMeasuring(calibration::CalibrationFolder& folder, rig::Rig& rig,
                                     const linearization::Linearization& linearization,
                                     const sentinels::AlarmHandler& handler,
                                     sentinels::AcquisitionObserver& observer,
                                     const OutlookObserver::Tell& outlook, calibration::RoomWaiter* room,
                                     Progress& progress);
/// Of the progress of measureAcquisition() and goOnMeasuring(): the share after which no photograph is taken
/// any more, and the result is worked out and stored.
constexpr double photographedShare = 0.95;
/// The parts of that progress in which no photograph is taken, by the ids of their names.
bool isWorkingOut(std::string_view stage);
/// Chooses the windows' ridge and keeps it, unless that is done. Throws: as invert(); Error{disk}.
void measureInverse(calibration::CalibrationFolder& folder, const compensation::MeasuredVenue& venue,
                    Progress& progress);

}  // namespace relucent::pipeline
