// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "relucent/base/enum_names.h"
#include "relucent/calibration/calibration_folder.h"

namespace relucent::pipeline {

/// Which photographs stay with a calibration that is complete. Of one that is not, all do: going on needs
/// them.
///
/// Results never need them again: compensation, verification, report and export read results alone. What
/// does is measuring once more with other settings, which reads the photographs that both have in common, and
/// an algorithm of a later version, which makes a better result of the same photographs.
enum class KeptPhotographs {
  everything,  // as they were taken
  latest,      // not those that were set aside when a stage was measured again: nothing reads them
  results      // none: other settings and later versions have to photograph everything again
};
inline constexpr EnumName<KeptPhotographs> keptPhotographsNames[]{
    {KeptPhotographs::everything, "everything", "all photographs"},
    {KeptPhotographs::latest, "latest", "not those set aside by measuring again"},
    {KeptPhotographs::results, "results",
     "no photographs: other settings then have to photograph everything again"}};
constexpr EnumNames<KeptPhotographs> namesOf(KeptPhotographs) {
  return {"choice of photographs", keptPhotographsNames};
}

/// What a calibration is asked for; everything, unless it says something else.
/// Throws: Error{format} for a choice of a later version.
KeptPhotographs keptPhotographs(const calibration::CalibrationFolder& folder);
/// No result depends on it. Removes nothing by itself. Throws: Error{disk}.
void keepPhotographs(calibration::CalibrationFolder& folder, KeptPhotographs kept);

/// Whether the light transport is measured with the settings as they are and to the end, so that nothing has
/// to go on from the photographs.
bool isComplete(const calibration::CalibrationFolder& folder);

/// The photographs that may go, in the order in which they have to: the last of a stage first, so that at any
/// instant the others are what an interrupted measurement leaves. None unless isComplete().
std::vector<std::filesystem::path> removablePhotographs(const calibration::CalibrationFolder& folder,
                                                        KeptPhotographs kept);

/// Files and what they take on the disk.
struct DiskShare {
  int files = 0;
  std::uint64_t bytes = 0;
};

/// Removes them. The manifest says first which result's photographs are gone, so that this is known however
/// it ends.
/// Throws: Error{disk} if one cannot be removed.
DiskShare removePhotographs(calibration::CalibrationFolder& folder, KeptPhotographs kept);
/// By the calibration's own choice: the end of a measurement.
DiskShare removePhotographs(calibration::CalibrationFolder& folder);

/// Whether the photographs were removed that the light transport follows from: with other settings
/// everything is photographed again.
bool werePhotographsRemoved(const calibration::CalibrationFolder& folder);

}  // namespace relucent::pipeline
