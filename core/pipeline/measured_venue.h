// SPDX-License-Identifier: MIT
#pragma once

#include "base/message.h"
#include "calibration/calibration_folder.h"
#include "compensation/ridge_choice.h"
#include "compensation/target.h"
#include "inverse/windows.h"
#include "linearization/linearization.h"
#include "pipeline/calibrate.h"
#include "transport/acquisition.h"

namespace relucent {

/// What is told of an acquisition once its T has become a venue: all but what a venue holds.
struct AcquisitionFigures {
  std::vector<std::uint8_t> flagged;
  Stack floodVariance;
  double unresolvedEnergy = 0.0;
  double verificationError = 0.0;
  std::vector<Message> findings;
};
AcquisitionFigures figuresOf(const Acquisition& acquisition);

/// A finished calibration in memory: all that compensation, export and the report need.
struct MeasuredCalibration {
  RigSettings rig;
  Linearization linearization;
  AcquisitionFigures acquisition;
  MeasuredVenue venue;
  WindowInverse inverse;
  double ridge = 0.0;                  // of the windows
  std::vector<RidgeTrial> ridgeCurve;  // how it was found
};

/// Which camera pixels compensation may rely on: lit by the projectors well above noise and black in every
/// channel, and not flagged by the verification.
std::vector<std::uint8_t> usablePixels(const Acquisition& acquisition);

/// What compensation needs to know, out of what acquisition measured: T thresholded and rescaled to the flood
/// image. A second T: whoever has no more use for the first lets go of the acquisition.
MeasuredVenue measuredVenueOf(const Acquisition& acquisition, const ThresholdSettings& threshold);

/// Reads what was measured, without inverting it. Throws: as loadCalibration().
MeasuredVenue loadMeasuredVenue(const CalibrationFolder& folder, Progress& progress);

/// The windows as the settings want them: with the ridge that suits the venue best, or the one given.
RidgeChoice invert(const MeasuredVenue& venue, const CalibrateSettings& settings, Progress& progress);

/// How the inverse was made, as the calibration keeps it.
InverseResult inverseResultOf(const RidgeChoice& choice, const StageCost& cost);

/// Reads a finished calibration. The inverse operator is made anew: quicker than reading it.
/// Throws: Error{input} naming the step that is missing if the calibration is not finished.
MeasuredCalibration loadCalibration(const CalibrationFolder& folder, Progress& progress);

/// What the stages found and cost, as calibrate() returns it; without peak memory.
CalibrateResult summaryOf(const CalibrationFolder& folder, const MeasuredCalibration& measured);

}  // namespace relucent
