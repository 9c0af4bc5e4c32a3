// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "relucent/base/progress.h"
#include "relucent/compensation/content_identity.h"
#include "relucent/compensation/method.h"
#include "relucent/compensation/target.h"
#include "relucent/pipeline/rig_settings.h"
#include "relucent/rig/rig.h"
#include "relucent/sentinels/movement.h"

namespace relucent::pipeline {

struct ProveSettings {
  std::filesystem::path image;  // content, sRGB file or linear EXR
  compensation::Method method = compensation::Method::refined;
  /// What stands on the projectors' displays already, one picture of drive values a projector (floating-point
  /// files: linear ones), whatever made it: proved in place of what `method` computes. Empty: that.
  std::vector<std::filesystem::path> shown{};
  compensation::TargetSettings target;
  std::filesystem::path out;       // folder; created; files of the same names are replaced
  std::optional<RigSettings> rig;  // none: the calibration's own; others must have its sizes
  /// That a show puts the content on: what it shows of it is proved, perfected if the picture is
  /// (perfected.h). None: the content alone, by `method`.
  std::optional<compensation::ContentCanvas> canvas{};
  std::string set{};  // whose target takes the place of `target`, see sets.h; empty: none's
};
std::vector<Message> problems(const ProveSettings& settings);

/// How far a picture on the surface is from the wanted one, as one camera sees it.
struct PictureError {
  double psnr = 0.0;    // dB over the reachable pixels, in linear light with the target's white as peak
  double deltaE = 0.0;  // mean CIEDE2000 over the content, as a viewer adapted to its white sees it
};

/// One projection: what T said of it, and what the camera saw.
struct ProvedProjection {
  PictureError predicted;
  PictureError measured;
  /// |measured - predicted| / |measured| over the content: how far T is believed rightly.
  double surprise = 0.0;
  /// The largest CIEDE2000 between what a patch of the content looks like and what was predicted of it, each
  /// the mean light of a square of 1/24 of the camera picture's width: an object that was added, or paint, is
  /// nothing in the mean of all.
  double worstPatch = 0.0;
  /// Where that is: its middle, from the left and from the top, shares of the camera's picture; 0, 0:
  /// unknown.
  std::array<double, 2> worstPlace{};
};

/// The same as another camera than the first sees it.
struct ProvedView {
  ProvedProjection before, after;
  double reachable = 0.0;
  sentinels::Movement moved{};
};

struct ProveResult {
  compensation::Method method = compensation::Method::refined;
  ProvedProjection before;  // the content as it is, in its place: method none
  ProvedProjection after;   // compensated, or what was shown
  double reachable = 0.0;   // share of the content's camera pixels
  /// Of the first camera's view since the venue was measured; says nothing unless it explains.
  sentinels::Movement moved{};
  int exposures = 0;
  double seconds = 0.0;              // of photographing
  std::vector<ProvedView> others{};  // cameras beyond the first, in their order
  bool perfected = false;            // what was proved was corrected by photographs of itself
  std::vector<std::filesystem::path> files;
};

/// The figures of one camera, from 0 on. Contract: it was proved.
ProvedView viewOf(const ProveResult& result, std::size_t camera);

/// Camera pixels: a view that has moved by more is no longer the one that T is of, twice what the checks of a
/// measurement let pass.
inline constexpr double plainShift = 0.6;

/// CIEDE2000 of the worst patch from which on something there has changed. Of 110 proofs of venues that had
/// not (seven, measured in two ways at two sizes, five pictures) the worst has 5.8, of those measured as
/// usual 2.9; paint, 16 to 22 on white.
inline constexpr double plainPatch = 7.0;
/// What both photographs see of their worst patch: who passes by one is not in the other.
double changedPatch(const ProvedView& view);
/// Where the corrected picture's is, see ProvedProjection::worstPlace.
inline const std::array<double, 2>& changedPlace(const ProvedView& view) {
  return view.after.worstPlace;
}

/// In every view within twice of what was predicted, nowhere moved by more than plainShift, or too close
/// to the wanted picture for anybody to see a difference (Delta E 00 of 1), and no patch of another look.
/// Twice of a picture that is hard to show is much: a bump and a painted patch hide in it, where these do
/// not.
bool isAsPredicted(const ProveResult& result);
bool isAsPredicted(const ProvedView& view);
/// The first camera, from 0 on, that sees something else than was predicted; none: all see it.
std::optional<std::size_t> viewThatDiffers(const ProveResult& result);

/// The mean CIEDE2000 from which errors are plain to see; one of 1 is just visible side by side.
inline constexpr double plainDeltaE = 5.0;
/// Errors in the first view that nobody overlooks, however well they were predicted.
inline bool isPlainToSee(const ProveResult& result) {
  return result.after.measured.deltaE >= plainDeltaE;
}

/// Where a picture of a proof lies: NAME, then the camera's number from the second on, then the end.
/// `camera`: from 0 on.
std::filesystem::path proofPicture(const std::filesystem::path& folder, const std::string& name,
                                   std::size_t camera, const std::string& end);

/// The verification shot: projects a picture as it is and compensated, photographs both with the
/// calibration's devices, and compares the photographs with what was wanted and with what T predicts.
/// Nothing of the calibration is changed. Writes into `out`: before.exr, after.exr (measured, camera signal
/// per second), target.png, before.png, after.png (to look at), before_delta_e.exr, after_delta_e.exr, and
/// comparison.png: target, before and after beside each other, below them the CIEDE2000 of before and after
/// from 0 (dark) to 20 (bright). Cameras beyond the first have the same with their number: target-2.png, ...
/// Where the camera is reduced (reductions.h), before_whole.png and
/// after_whole.png are all that it delivers, photographed once more.
/// Throws: Error{input} if the calibration is not finished, was imported, has other sizes than the devices,
/// nothing of the picture can be shown, or what was shown has another size than the projectors;
/// Error{device, disk}; Cancelled.
ProveResult proveCalibration(const std::filesystem::path& folder, const ProveSettings& settings,
                             const std::filesystem::path& cache, Progress& progress);
/// The same with devices that somebody has open already.
ProveResult proveCalibration(const std::filesystem::path& folder, const ProveSettings& settings,
                             rig::Rig& rig, Progress& progress);

}  // namespace relucent::pipeline
