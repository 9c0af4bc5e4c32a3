// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "relucent/acquisition/reverification.h"
#include "relucent/calibration/stage_results.h"
#include "relucent/compensation/ridge_choice.h"
#include "relucent/compensation/uncorrectable.h"
#include "relucent/image/image.h"
#include "relucent/linearization/linearization.h"
#include "relucent/pipeline/calibrate.h"
#include "relucent/pipeline/evaluate.h"
#include "relucent/pipeline/night_record.h"
#include "relucent/pipeline/perfected.h"
#include "relucent/pipeline/versions.h"
#include "relucent/report/settings_words.h"

namespace relucent::report {

/// One image before and after, as the first camera sees it. Linear, camera signal per second, one size.
struct ReportComparison {
  std::string name;                                             // "Evening hills"
  compensation::Method method = compensation::Method::refined;  // of `compensated`
  image::Image wanted;  // light under an even white, as the two after it
  image::Image uncompensated;
  image::Image compensated;
  std::array<float, 3> white{};         // signal of the content's white
  CameraMask inside;                    // per pixel: the content covers it; empty: everywhere
  double reachable = 0.0;               // share of the content's pixels
  bool truth = false;                   // through a simulated venue's true transport; else predicted from T
  std::optional<double> uncertainty{};  // of a prediction, share of white: 95 of 100 pixels come within
  std::optional<compensation::UnreachableShares> unreachable{};  // of a prediction: what is not, and why
};

/// The newest verification photograph: the content, projected as it is and compensated. To look at.
struct ReportVerificationView {
  image::Image wanted, before, after;
  double deltaEBefore = 0.0, deltaEAfter = 0.0;
  std::optional<double> deltaEPredicted{};
};
struct ReportVerification {
  image::Image wanted, before, after;
  double deltaEBefore = 0.0;  // means over the content, CIEDE2000
  double deltaEAfter = 0.0;
  std::string taken;                             // when, ISO 8601
  std::optional<double> deltaEPredicted{};       // of the compensated one; none: the record of that is lost
  std::optional<bool> isAsPredicted{};           // pipeline/prove.h
  std::vector<ReportVerificationView> others{};  // of cameras beyond the first, in their order
  std::optional<std::size_t> viewThatDiffers{};  // which camera does not see what was predicted, from 0 on
  std::string picture{};     // its file's name; empty: nobody kept it, or the program's own
  bool isOutOfDate = false;  // it shows what was shown then: that was measured or chosen anew since
};

/// The newest check for drift.
struct ReportDrift {
  acquisition::Verdict verdict = acquisition::Verdict::stillGood;
  double error = 0.0, errorThen = 0.0;  // of the test patterns, relative: at the check, when T was measured
  double changedShare = 0.0;            // of the view
  std::string checked;                  // when, ISO 8601
};

/// A picture that was corrected by photographs of itself, and is shown so.
struct ReportPerfected {
  std::string name;  // of its file
  std::string when;  // ISO 8601
  pipeline::PerfectedFigures figures;
};

/// That it was made to fit what had changed, instead of being measured again.
struct ReportRepair {
  std::string when;  // ISO 8601
  std::vector<Message> what;
  double deltaEBefore = 0.0, deltaEAfter = 0.0;  // of a photographed picture
  calibration::StageCost cost{};
};

/// Everything that a report shows. What is empty is left out.
struct ReportData {
  std::string title;  // the calibration's name
  std::string venue;  // "Simulated venue corner: a glossy V-shaped corner before wallpaper"
  bool isSimulated = false;
  std::string software;  // that measured
  std::string measured;  // when, ISO 8601; of a repaired venue that is when it was repaired
  std::optional<ReportRepair> repaired;
  Size projector;
  Size camera;
  std::size_t projectors = 1, cameras = 1;  // those are the first ones' sizes
  pipeline::CalibrateResult result;         // its findings too
  int linearizationPatterns = 0;            // of all in result
  int stoppedAt =
      0;  // side of the finest blocks, projector pixels, if it was stopped and kept; 0: it was not
  std::vector<linearization::ProjectorResponse> responses;  // per projector
  std::vector<double> additivityError;                      // per projector
  std::vector<double> exposures;                            // seconds
  image::Image flood;                                       // T 1, less e: camera signal per second
  image::Image black;                                       // e
  CameraMask flagged;                                       // per camera pixel
  std::vector<std::uint64_t> leavesPerLevel;                // level 0 first: single pixels, then 2x2, ...
  std::vector<compensation::RidgeTrial> ridgeCurve;  // how the inverse's ridge was found, and which it is
  double ridge = 0.0;
  std::vector<ReportComparison> comparisons;
  std::optional<pipeline::EvaluateResult> evaluation;
  std::optional<ReportVerification> verification;
  std::optional<ReportDrift> drift;
  std::vector<ReportPerfected> perfected;     // as they are shown now
  std::vector<pipeline::NightRecord> nights;  // the last ones, oldest first
  std::vector<NamedText> settings;
  std::vector<pipeline::LibraryVersion> libraries;
};

}  // namespace relucent::report
