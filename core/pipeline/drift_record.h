// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "relucent/acquisition/reverification.h"

namespace relucent::pipeline {

/// What is kept of a check for drift.
struct DriftRecord {
  std::string checked;      // ISO 8601, UTC
  std::string measurement;  // when the light transport was measured that it belongs to
  acquisition::Verdict verdict = acquisition::Verdict::stillGood;
  double error = 0.0;         // of the test patterns now, relative
  double errorThen = 0.0;     // and when they were measured
  double changedShare = 0.0;  // of the view
  double ambient = 0.0;       // what the room is brighter by, of full light
  double lamp = 1.0;          // of the projector's light, a share of what it was
};

inline constexpr const char* driftRecordName = "drift.json";

/// Writes it into a folder, which is created. Throws: Error{disk}.
void saveDriftRecord(const DriftRecord& record, const std::filesystem::path& folder);

/// None where the folder holds none. Throws: Error{disk, format} if it cannot be read.
std::optional<DriftRecord> loadDriftRecord(const std::filesystem::path& folder);

}  // namespace relucent::pipeline
