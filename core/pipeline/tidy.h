// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "relucent/base/message.h"
#include "relucent/base/progress.h"
#include "relucent/pipeline/kept_photographs.h"

namespace relucent::pipeline {

struct TidySettings {
  std::optional<KeptPhotographs> kept;  // none: what each calibration was asked for
  bool dryRun = false;                  // only says what would be freed
};

/// What tidying one calibration frees.
struct TidiedCalibration {
  std::filesystem::path folder;
  DiskShare photographs;    // removed
  DiskShare leftovers;      // of interrupted writes
  DiskShare results;        // that newer ones of the same settings have replaced
  DiskShare perfected;      // pictures that no show finds any more, see isOutOfDate()
  DiskShare compressed;     // of earlier versions; bytes saved
  DiskShare kept;           // photographs that stay, as they then are
  bool isComplete = false;  // else all photographs stay
  std::uint64_t freed() const {
    return photographs.bytes + leftovers.bytes + results.bytes + perfected.bytes + compressed.bytes;
  }
};

struct TidyResult {
  std::vector<TidiedCalibration> calibrations;
  bool dryRun = false;
};

/// Frees the disk of what calibrations do not need: photographs that are not to be kept, what interrupted
/// writes left, results that newer ones of the same settings have replaced, perfected pictures that are out
/// of date; and compresses, without loss,
/// photographs of earlier versions. Interrupted at any instant, nothing that is needed is lost: every
/// compressed file is read back and compared before it takes the place of the old one.
/// All calibrations are opened before the first is changed.
/// Throws: as CalibrationFolder::open(); Error{disk} if something cannot be removed or written; Cancelled.
TidyResult tidy(const std::vector<std::filesystem::path>& folders, const TidySettings& settings,
                Progress& progress);

}  // namespace relucent::pipeline
