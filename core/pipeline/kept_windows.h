// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "relucent/calibration/calibration_folder.h"
#include "relucent/calibration/prepared_files.h"
#include "relucent/compensation/target.h"
#include "relucent/inverse/windows.h"

/// The windows' inverse beside a calibration's results, in results/windows.npz: reading it takes a second
/// where making it takes half a minute. It is no result: whoever does not find it there, or finds that of
/// another light transport, makes it. There is one, the last that was chosen.
namespace relucent::pipeline {

/// Where there is no room for it, it is not kept. Throws: Error{disk} if it cannot be written for another
/// reason.
void keepWindows(const calibration::CalibrationFolder& folder, const compensation::MeasuredVenue& venue,
                 const inverse::WindowSettings& settings, const inverse::WindowInverse& windows);

/// The same in two steps: written before it is known whether they will be those of the calibration, ...
void prepareWindows(const calibration::PreparedFiles& files, const compensation::MeasuredVenue& venue,
                    const inverse::WindowSettings& settings, const inverse::WindowInverse& windows);
/// ... and put in their place, if there was room for them. Throws: Error{disk}.
void keepWindows(const calibration::CalibrationFolder& folder, const calibration::PreparedFiles& files);

/// As computeWindows() would make them of this venue, bit for bit. None: they are not there, or damaged.
std::optional<inverse::WindowInverse> keptWindows(const calibration::CalibrationFolder& folder,
                                                  const compensation::MeasuredVenue& venue,
                                                  const inverse::WindowSettings& settings);

}  // namespace relucent::pipeline
