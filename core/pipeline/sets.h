// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "relucent/base/message.h"
#include "relucent/calibration/calibration_folder.h"
#include "relucent/calibration/json_fwd.h"
#include "relucent/pipeline/content_settings.h"

namespace relucent::pipeline {

/// What a calibration is to show and how, under a name: for the day, the night, a school class.
struct TargetSet {
  std::string name;  // UTF-8
  ContentSettings content;

  bool operator==(const TargetSet&) const = default;
};

/// All sets of a calibration, in the order in which they were saved. The calibration's content is that of the
/// set in use: whoever changes it changes that set. Either there is no set, and the content has no name, or
/// one of them is in use.
struct TargetSets {
  std::vector<TargetSet> all;
  std::size_t inUse = 0;  // of all; nothing if there are none

  /// Empty: the content has no name.
  std::string nameInUse() const { return all.empty() ? std::string() : all[inUse].name; }
  std::vector<std::string> names() const;
  bool operator==(const TargetSets&) const = default;
};

/// Most bytes of a set's name.
inline constexpr std::size_t longestSetName = 60;
/// What is wrong with a name; empty: nothing. It is UTF-8 without control characters, neither empty nor too
/// long, and does not begin or end with a space.
Message problemOfSetName(const std::string& name);

/// Of a calibration of an earlier version there are none. Throws: Error{format} if they cannot be read, or a
/// newer version wrote them.
TargetSets setsOf(const calibration::CalibrationFolder& folder);

/// Each is one atomic change of the manifest. Throws: Error{input} with a sentence for a name that is none,
/// or a set that there is not; Error{format, disk}.

/// The content as it is now becomes a set of this name, too, which is in use from now on: what is changed
/// later is not changed in the one that was in use before. Content without a name gets it.
void saveSet(calibration::CalibrationFolder& folder, const std::string& name);
/// The calibration's content becomes that set's.
void useSet(calibration::CalibrationFolder& folder, const std::string& name);
void renameSet(calibration::CalibrationFolder& folder, const std::string& from, const std::string& to);
/// Of the set in use, only the last one can be removed: then the content stays, without a name.
void removeSet(calibration::CalibrationFolder& folder, const std::string& name);

/// Opens a calibration for reading, with the content of a set in place of the one in use; empty: that one.
/// Throws: as CalibrationFolder::open(), setsOf(); Error{input} if there is no such set.
calibration::CalibrationFolder openWithSet(const std::filesystem::path& path, const std::string& name);

/// The target of a calibration that was opened with that set; with none, `otherwise`, with the calibration's
/// masks where it says nothing of them.
compensation::TargetSettings targetIn(const calibration::CalibrationFolder& folder, const std::string& set,
                                      const compensation::TargetSettings& otherwise);

/// What of the manifest's settings says what is shown, the content and that of all sets, as it would be if
/// each were changed so: sections of them, JSON. Throws: as setsOf().
std::string contentSections(const calibration::CalibrationFolder& folder,
                            const std::function<ContentSettings(const ContentSettings&)>& change);

/// {"in_use", "sets": [{"name", "content"}, ...]}, each with all of its content.
calibration::Json toJson(const TargetSets& sets);

/// What content follows from in shows of each set, of fingerprintOfShown().
std::vector<std::string> fingerprintsOfSets(const calibration::CalibrationFolder& folder);

}  // namespace relucent::pipeline
