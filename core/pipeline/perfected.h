// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "relucent/base/raster.h"
#include "relucent/calibration/calibration_folder.h"
#include "relucent/compensation/content_identity.h"
#include "relucent/image/image.h"
#include "relucent/pipeline/content_settings.h"
#include "relucent/pipeline/prove.h"

namespace relucent::pipeline {

/// What a picture was before it was perfected, and after, as every camera saw it.
struct PerfectedFigures {
  std::vector<PictureError> before, after;  // camera after camera, photographed one after the other
  int photographs = 0;                      // of the picture, all told
};

/// A still picture that was corrected by photographs of itself. It belongs to a calibration, to how content
/// is shown there, and to the picture's file; of anything else it is not found.
struct PerfectedPicture {
  std::string key;               // see perfectedKey()
  std::filesystem::path folder;  // of the calibration
  std::string picture;           // its file as it was named
  std::string perfected;         // when, ISO 8601, UTC
  PerfectedFigures figures;
  std::vector<std::string> files;  // linear drive, EXR, one a projector; names beside the record
  // What the key follows from besides the picture's file; of earlier versions: not known.
  std::string shownFrom{};
  std::optional<compensation::ContentCanvas> canvas{};
};

/// Where these lie within a calibration.
std::filesystem::path perfectedFolder(const std::filesystem::path& calibration);

/// Under which one is kept. `shownFrom`: of fingerprintOfShown(). `content`: of contentIdentity().
std::string perfectedKey(const std::string& shownFrom, const std::string& content);

/// The same of a picture's file, `picture` its size, as a show of this calibration has it on a canvas now.
/// Throws: as readFile(), fingerprintOfShown().
std::string perfectedKeyOf(const calibration::CalibrationFolder& folder, const std::filesystem::path& file,
                           Size picture, const compensation::ContentCanvas& canvas);

/// Replaces what there is of this key, atomically: after a crash either the old or the new one is there.
/// `projector`: linear drive. Returns the files. Throws: Error{disk}.
std::vector<std::filesystem::path> savePerfected(PerfectedPicture picture, const ProjectorStack& projector,
                                                 const Rasters& projectors);

/// None: that picture was not perfected, or not as it is shown now.
/// Throws: Error{disk, format} if there is one that cannot be read.
std::optional<PerfectedPicture> findPerfected(const std::filesystem::path& calibration,
                                              const std::string& key);

/// Its linear drive. Throws: Error{disk, format}; Error{input} if it has other sizes.
ProjectorStack driveOf(const PerfectedPicture& picture, const Rasters& projectors);

/// All of a calibration, also those out of date, in the order of their keys. What cannot be read is left out.
std::vector<PerfectedPicture> allPerfected(const std::filesystem::path& calibration);

/// Is another one as soon as any is kept, replaced or removed.
std::string perfectedState(const std::filesystem::path& calibration);

/// The picture is shown as T has it again. Throws: Error{disk}.
void removePerfected(const PerfectedPicture& picture);

}  // namespace relucent::pipeline
