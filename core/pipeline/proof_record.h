// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "relucent/pipeline/content_settings.h"
#include "relucent/pipeline/prove.h"

namespace relucent::pipeline {

/// What is kept of a verification photograph beside its pictures: figures, time, and what it was taken of.
struct ProofRecord {
  std::string taken;        // ISO 8601, UTC
  std::string measurement;  // when the light transport was measured that it belongs to
  ContentSettings content;
  ProveResult figures;  // method, before, after, reachable, moved
};

/// Writes proof.json into a folder. Throws: Error{disk}.
void saveProofRecord(const ProofRecord& record, const std::filesystem::path& folder);

/// None where the folder holds no proof.json. Throws: Error{disk, format} if it cannot be read.
std::optional<ProofRecord> loadProofRecord(const std::filesystem::path& folder);

}  // namespace relucent::pipeline
