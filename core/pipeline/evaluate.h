// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "relucent/base/progress.h"
#include "relucent/base/raster.h"
#include "relucent/compensation/methods.h"
#include "relucent/compensation/rivals.h"
#include "relucent/compensation/seams.h"
#include "relucent/compensation/target.h"
#include "relucent/pipeline/compensate.h"
#include "relucent/pipeline/viewer_walk.h"

namespace relucent::pipeline {

struct EvaluateSettings {
  std::vector<std::filesystem::path> images;  // none: judgedImages()
  bool fewImages = false;                     // without `images`: standardImages() alone
  std::vector<compensation::Method> methods;  // none: all of them
  /// What others do, besides; some of them take photographs by the simulated devices, as one would there.
  std::vector<compensation::Rival> rivals{};
  compensation::RivalSettings rivalSettings{};
  compensation::TargetSettings target;
  compensation::CompensatorSettings compensator;
  /// Whether several projectors are also compared with each of them solved on its own and blended, and with
  /// each of them alone.
  bool blended = false;
  /// Whether every picture is also corrected by so many photographs of itself (perfecting_loop.h); 0: no.
  int perfected = 0;
  /// The venue as it has become since it was measured; none: the calibration's own.
  std::optional<RigSettings> rig{};
  WalkSettings walk{};  // a viewer who walks past the cameras, by the first image
  std::string set{};    // whose target takes the place of `target`, see sets.h; empty: none's
};
std::vector<Message> problems(const EvaluateSettings& settings);

/// How well one method did on one image, through the venue's true transport. Over all pixels that hold
/// content, or over those of them that can be reached: NaN where there are none.
struct MethodScore {
  compensation::Method method = compensation::Method::none;
  double psnrReachable = 0.0;  // dB, linear light, peak = the target's white
  double psnrAll = 0.0;
  double encodedPsnrReachable = 0.0;  // dB, of what viewed() gives
  double encodedPsnrAll = 0.0;
  double ssim = 0.0;  // all
  double multiScaleSsim = 0.0;
  double deltaEReachable = 0.0;   // mean CIEDE2000
  double deltaE = 0.0;            // the same, of all
  double deltaEPercentile = 0.0;  // what 95 % of all do not exceed
  double seconds = 0.0;           // for one frame
};

/// What one of several projectors would make of an image alone, the others black.
struct AloneScore {
  double reachable = 0.0;                // share of the image's pixels in that view: e <= wanted <= T_k 1 + e
  std::optional<MethodScore> optimum{};  // over the pixels that all projectors together reach
};

/// The same of what others do.
struct RivalScore {
  compensation::Rival rival = compensation::Rival::corrected;
  int photographs = 0;  // that it took: of this picture, or, of `robust`, of the venue
  MethodScore score{};  // its `method` says nothing
};

/// What another camera, or a viewer where none stands, sees of an image on the surface. Without methods it is
/// nothing of it.
struct ViewScore {
  double reachable = 0.0;  // share of the image's pixels in that view
  std::vector<MethodScore> methods;
  std::optional<MethodScore> blended{};  // each projector's optimum on its own, under cosine ramps
  std::vector<AloneScore> alone{};       // projector after projector
  std::vector<RivalScore> rivals{};
  std::vector<MethodScore> perfected{};  // `refined`, as it was shown for one photograph after the other
};

/// What masks do, judged by the true light (mask_score.h).
struct MaskScore {
  compensation::Method method = compensation::Method::refined;
  double light = 0.0;        // on what is masked, with masks, as a share of what was there without
  double direct = 0.0;       // the same of direct light alone
  double psnrWithout = 0.0;  // dB of the picture elsewhere, where it can be reached: without masks
  double psnr = 0.0;         // and with them
  double white = 1.0;        // the content's, with masks, as a share of what it was
};

/// What the first camera sees, in whose view the image lies.
struct ImageScore {
  std::string name;
  double reachable = 0.0;  // share of this image's pixels
  std::vector<MethodScore> methods;
  std::optional<MethodScore> blended{};  // as ViewScore
  std::vector<AloneScore> alone{};       // likewise
  std::vector<RivalScore> rivals{};      // likewise
  std::vector<MethodScore> perfected{};  // likewise
  std::vector<ViewScore> others{};       // camera after camera
  std::vector<ViewScore> unseen{};       // what viewers see who stand where no camera does, place after place
  std::optional<ContradictionShares> contradiction{};  // of several views, as the last method has it
  /// Share of all views' values, where pixels are usable, that the last method's prediction is as near to as
  /// it expects for 95 % of them (compensation/expected_error.h).
  std::optional<double> asExpected{};
  std::optional<MaskScore> masked{};  // by the last method; none: there are no masks
};

/// What is seen of the edges of projectors' pictures where a flat grey is wanted (compensation/seams.h).
struct SeamScore {
  double grey = 0.0;  // share of white's light
  compensation::Method method = compensation::Method::refined;
  compensation::Seams joint;    // with the last of the methods
  compensation::Seams blended;  // each projector on its own
  compensation::Seams roomy{};  // as `joint`, of pixels asked for at most 0.7 of what all projectors give
};

/// What is seen of the edges of projectors' black (compensation/black_steps.h).
struct BlackSteps {
  double lift = 0.0;       // of black, share of white, as it was asked for or found
  double p95 = 0.0;        // CIEDE2000, with it
  double leastLift = 0.0;  // with which it is not seen
};

/// How well T itself was measured; relative errors.
struct TransportScore {
  double frobenius = 0.0;
  double rowMedian = 0.0;
  double rowP95 = 0.0;
  double relightNatural = 0.0;
  double relightRandom = 0.0;
  double energy = 0.0;  // of T 1 over the truth's; 1: all light, and none twice
};

struct EvaluateResult {
  std::string venue;
  Size projector;
  Size camera;
  double reachable = 0.0;  // mean over images
  TransportScore transport;
  std::vector<ImageScore> images;
  std::vector<SeamScore> seams{};          // if separate solves were asked for
  std::optional<BlackSteps> blackSteps{};  // likewise
  std::vector<WalkFrame> walk{};           // if a viewer walks
};

/// PSNR of the reachable pixels with a method, mean of the images, dB.  Contract: it was compared.
double meanPsnr(const EvaluateResult& result, compensation::Method method);

/// Compares every method through the true transport of the simulated venue that was calibrated. Where the
/// venue has viewers whom no camera stands in for, their views are judged too, as long as the content lies on
/// the surface in all of the cameras'. Throws: Error{input} if the calibration is of a real venue: its truth
/// is not known.
EvaluateResult evaluate(const std::filesystem::path& folder, const EvaluateSettings& settings,
                        const std::filesystem::path& cache, Progress& progress);

}  // namespace relucent::pipeline
