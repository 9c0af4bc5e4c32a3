// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "relucent/acquisition/renewal.h"
#include "relucent/base/enum_names.h"
#include "relucent/base/progress.h"
#include "relucent/pipeline/prove.h"
#include "relucent/pipeline/rig_settings.h"
#include "relucent/rig/rig.h"

namespace relucent::pipeline {

struct RepairSettings {
  std::filesystem::path image;     // by which it is proved; empty: the content's picture, else a standard one
  std::optional<RigSettings> rig;  // none: the calibration's own; others must have its sizes
  acquisition::RenewalSettings renewal{};
};

/// What came of it.
enum class RepairEnd {
  nothingToDo,  // the venue is as it was measured
  repaired,     // what was found is in use
  notBetter,    // the picture is not better by it, as photographed: the former measurement stays
};
inline constexpr EnumName<RepairEnd> repairEndNames[]{
    {RepairEnd::nothingToDo, "nothing-to-do", "the venue is as it was measured"},
    {RepairEnd::repaired, "repaired", "the calibration fits the venue again"},
    {RepairEnd::notBetter, "not-better", "the picture did not become better by it"}};
constexpr EnumNames<RepairEnd> namesOf(RepairEnd) {
  return {"outcome of a repair", repairEndNames};
}

struct RepairResult {
  RepairEnd end = RepairEnd::nothingToDo;
  acquisition::VenueChange change;
  std::vector<Message> what;  // has changed, a sentence each
  double errorThen = 0.0;     // of test patterns, relative, when T was measured
  // Beyond noise, see acquisition::Renewal.
  double errorBefore = 0.0, errorAdapted = 0.0, errorAfter = 0.0;
  double measured = 0.0;                    // share of camera pixels that were measured again
  std::vector<PictureError> before, after;  // of a picture by photograph, camera after camera; empty: not
                                            // photographed, as nothing had changed
  int exposures = 0;
  double seconds = 0.0;  // of photographing, computing and storing; reading the calibration not included
  double photographing = 0.0;  // seconds of these that the devices took, part of them while was computed
};

/// Makes a calibration fit what its venue has become (acquisition/renewal.h), from photographs by its
/// devices. It is committed only if a picture, as a show has it by the former T and by the new one,
/// photographed one after the other, is better with the new one, or no worse while test patterns' error has
/// become half; then it is found in place of the former measurement, which stays, and undoRepair() goes back
/// to it. Until the last step, which is atomic, nothing of the calibration is changed. Throws: Error{input}
/// if the calibration is not finished, was imported, or has other sizes than the devices, or if another
/// program changed it meanwhile; Error{device} if something disturbs the photographs again and again, or
/// hardly any light is left; Error{disk}; Cancelled.
RepairResult repairCalibration(const std::filesystem::path& folder, const RepairSettings& settings,
                               const std::filesystem::path& cache, Progress& progress);
/// The same with devices that somebody has open already.
RepairResult repairCalibration(const std::filesystem::path& folder, const RepairSettings& settings,
                               rig::Rig& rig, Progress& progress);

/// A measurement that was taken back.
struct UndoneRepair {
  std::string stored;  // when the measurement that is used again was stored, ISO 8601, UTC
};
/// The measurement from before the last repair is used again.
/// Throws: Error{input} if the present one was not repaired, or what it was made from has been removed.
UndoneRepair undoRepair(const std::filesystem::path& folder);

}  // namespace relucent::pipeline
