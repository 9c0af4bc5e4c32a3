// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "relucent/base/error.h"
#include "relucent/calibration/calibration_folder.h"
#include "relucent/calibration/json.h"

/// What the files of this folder that turn results into JSON and back have in common.
namespace relucent::calibration {

/// Of a manifest's entry, true: a result that is not found any more.
inline constexpr const char* setAsideKey = "set_aside";
inline bool isSetAside(const Json& entry) {
  return entry.value(setAsideKey, false);
}

inline constexpr auto damagedAdvice = RELUCENT_ENGLISH_MESSAGE(
    "calibration.restore-or-calibrate-again", "restore the calibration from a copy, or calibrate again");

/// Runs `read` on a result's values, turning what the JSON library throws into one sentence.
/// Throws: Error{format}.
template <typename Read>
auto readingJson(const StageResult& result, const Read& read) {
  try {
    return read(*result.values);
  } catch (const Json::exception& cause) {
    throw Error(ErrorKind::format,
                RELUCENT_ENGLISH_MESSAGE("calibration.result-unreadable",
                                         "the result of the stage \"{}\" cannot be read ({})")
                    .with(nameOf(result.stage), cause.what()),
                damagedAdvice, result.folder.string());
  }
}

Json toJson(const StageCost& cost);
Json toJson(const RepairNote& repair);
/// None: it was not repaired.
std::optional<RepairNote> repairFrom(const Json& values);
Json toJson(const transport::ExpectedQuality& expected);
/// None: the document has none, as those of earlier versions.
std::optional<transport::ExpectedQuality> expectedFrom(const Json& values);
Json toJson(const transport::FoundChange& changed);
/// None: nothing had changed when it ended.
std::optional<transport::FoundChange> changedFrom(const Json& values);
/// As lists of width and height.
std::vector<Size> sizesFrom(const Json& json);

}  // namespace relucent::calibration
