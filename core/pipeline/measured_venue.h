// SPDX-License-Identifier: MIT
#pragma once

#include "relucent/base/message.h"
#include "relucent/calibration/calibration_folder.h"
#include "relucent/compensation/expected_error.h"
#include "relucent/compensation/ridge_choice.h"
#include "relucent/compensation/target.h"
#include "relucent/inverse/windows.h"
#include "relucent/linearization/linearization.h"
#include "relucent/pipeline/calibrate.h"
#include "relucent/reduction/reduction.h"
#include "relucent/transport/acquisition.h"

namespace relucent::pipeline {

/// What is told of an acquisition once its T has become a venue: all but what a venue holds.
struct AcquisitionFigures {
  CameraMask flagged;
  compensation::TransportVariance variance;  // of an import nothing is known of the leaves': empty
  double unresolvedEnergy = 0.0;
  double verificationError = 0.0;
  std::vector<Message> findings;
};
AcquisitionFigures figuresOf(const transport::Acquisition& acquisition);

/// A finished calibration in memory: all that compensation, export and the report need.
struct MeasuredCalibration {
  RigSettings rig;
  std::vector<reduction::Reduction> reductions;  // of its cameras; empty: they are used as they are
  linearization::Linearization linearization;
  AcquisitionFigures acquisition;
  compensation::MeasuredVenue venue;
  inverse::WindowInverse inverse;
  double ridge = 0.0;                                // of the windows
  std::vector<compensation::RidgeTrial> ridgeCurve;  // how it was found
};

/// Which camera pixels compensation may rely on: lit by the projectors well above noise and black in every
/// channel, and not flagged by the verification.
CameraMask usablePixels(const transport::Acquisition& acquisition);

/// What compensation needs to know, out of what acquisition measured: T thresholded and rescaled to the flood
/// image. A second T: whoever has no more use for the first lets go of the acquisition.
compensation::MeasuredVenue measuredVenueOf(const transport::Acquisition& acquisition,
                                            const transport::ThresholdSettings& threshold);

struct RenewedVenue {
  compensation::MeasuredVenue venue;
  CameraMask
      changed;  // camera pixels whose rows of T differ from those before, or that are usable now or were
};
/// The same as measuredVenueOf(), where `former` is that of a measurement from which this one became: rows
/// that are as they were are not looked at again.
RenewedVenue renewedVenueOf(const transport::Acquisition& acquisition,
                            const transport::ThresholdSettings& threshold,
                            const compensation::MeasuredVenue& former);

/// Reads what was measured, without inverting it. Throws: as loadCalibration().
compensation::MeasuredVenue loadMeasuredVenue(const calibration::CalibrationFolder& folder,
                                              Progress& progress);

/// The windows as the settings want them: with the ridge that suits the venue best, or the one given.
compensation::RidgeChoice invert(const compensation::MeasuredVenue& venue, const CalibrateSettings& settings,
                                 Progress& progress);

/// How the inverse was made, as the calibration keeps it.
calibration::InverseResult inverseResultOf(const compensation::RidgeChoice& choice,
                                           const calibration::StageCost& cost);

/// Reads a finished calibration, all but the inverse. Throws: as loadCalibration().
MeasuredCalibration loadMeasurements(const calibration::CalibrationFolder& folder, Progress& progress);

/// Where a threshold cuts T: only what it leaves is held, or all that was measured besides, for predictions.
enum class Held { whatIsLeft, allMeasured };

/// Reads a finished calibration. The inverse operator is read where it is kept, else made again.
/// Throws: Error{input} naming the step that is missing if the calibration is not finished.
MeasuredCalibration loadCalibration(const calibration::CalibrationFolder& folder, Progress& progress,
                                    Held held = Held::whatIsLeft);
/// The same, and `acquisition` as it is stored, which is read anyway.
MeasuredCalibration loadCalibration(const calibration::CalibrationFolder& folder,
                                    transport::Acquisition& acquisition, Progress& progress);

/// What the stages found and cost, as calibrate() returns it; without peak memory.
CalibrateResult summaryOf(const calibration::CalibrationFolder& folder, const MeasuredCalibration& measured);

}  // namespace relucent::pipeline
