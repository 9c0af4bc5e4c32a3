// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <vector>

#include "relucent/base/progress.h"
#include "relucent/compensation/content_identity.h"
#include "relucent/pipeline/perfected.h"
#include "relucent/pipeline/perfecting_loop.h"
#include "relucent/pipeline/rig_settings.h"
#include "relucent/rig/rig.h"

namespace relucent::pipeline {

struct PerfectSettings {
  std::vector<std::filesystem::path> images;  // content, sRGB files or linear EXR
  compensation::ContentCanvas canvas;         // that the show puts them on
  int photographs = 6;                        // of each at most, before the last two
  std::optional<RigSettings> rig;             // none: the calibration's own; others must have its sizes
  std::string set{};                          // as which they are shown, see sets.h; empty: the one in use
};
std::vector<Message> problems(const PerfectSettings& settings);

/// What became of one picture.
struct PerfectedImage {
  std::filesystem::path image;
  Message failure;  // why nothing was done; empty: it was
  PerfectingEnd end = PerfectingEnd::allTaken;
  Message disturbance;  // what was in the way
  bool kept = false;    // it is better than what there was, and shown from now on
  bool wentOn = false;  // from one that had been perfected before
  std::vector<PerfectingRound> rounds;
  PerfectingRound before, after;
  int photographs = 0;  // of pictures, all told
  std::vector<std::filesystem::path> files;
};

struct PerfectResult {
  std::vector<PerfectedImage> images;
  int exposures = 0;
  double seconds = 0.0;  // of photographing and solving
};

/// Whether every picture is now as good as it can be seen to be.
bool isPerfect(const PerfectResult& result);

/// Told of every photograph while a picture is perfected, by the thread that does the work. `image`: from 0
/// on.
using PerfectingObserver = std::function<void(std::size_t image, const PerfectingRound&)>;

/// Shows still pictures one after the other as the calibration's content is shown, corrects each by
/// photographs of itself (perfecting_loop.h), and keeps what is better for shows of it (perfected.h). It goes
/// on from what was kept before. A picture that cannot be read or shown is told of and left out; something in
/// the way leaves it as it was. Throws: Error{input} if the calibration is not finished, was imported, or has
/// other sizes than the devices; Error{device, disk}; Cancelled: then what is finished stays, and the picture
/// under way is as it was.
PerfectResult perfectPictures(const std::filesystem::path& folder, const PerfectSettings& settings,
                              const std::filesystem::path& cache, const PerfectingObserver& observer,
                              Progress& progress);
/// The same with devices that somebody has open already.
PerfectResult perfectPictures(const std::filesystem::path& folder, const PerfectSettings& settings,
                              rig::Rig& rig, const PerfectingObserver& observer, Progress& progress);

/// Whether a still is kept perfected as a set shows it now; empty: the one in use.
/// Throws: Error{disk, format}.
bool isPerfected(const std::filesystem::path& folder, const std::filesystem::path& image,
                 const compensation::ContentCanvas& canvas, const std::string& set = {});

/// Whether no show of this calibration finds it any more, by whichever set: something else is measured or
/// chosen now, or its file has become another picture. One whose file is away for now is not out of date.
/// Throws: Error{disk}.
bool isOutOfDate(const PerfectedPicture& picture, const calibration::CalibrationFolder& folder);

struct ForgottenPictures {
  std::vector<std::string> pictures;  // as they were named
};
/// These pictures are shown as T has them again, by that set; none named: all of the calibration and of all
/// sets.
/// Throws: Error{input} if there is no calibration; Error{disk}.
ForgottenPictures forgetPerfected(const std::filesystem::path& folder,
                                  const std::vector<std::filesystem::path>& images,
                                  const compensation::ContentCanvas& canvas, const std::string& set = {});

}  // namespace relucent::pipeline
