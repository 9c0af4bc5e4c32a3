// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <memory>

#include "relucent/pipeline/proof_record.h"
#include "wizard/output/output_proof.h"

namespace relucent::gui {

/// The folder of a calibration's verification photograph.
std::filesystem::path proofFolder(const std::filesystem::path& calibration);

/// The pictures of so many cameras that lie there. Throws: Error{disk, format}.
std::vector<ProofView> proofViews(const std::filesystem::path& folder, std::size_t cameras);

/// What is kept of it beside the pictures.
pipeline::ProofRecord recordOf(const Proof& proof);

/// Keeps figures, time and what they were taken of beside the pictures, as proof.json.  Throws: Error{disk}.
void saveProof(const Proof& proof, const std::filesystem::path& folder);

/// The verification photograph that lies in the folder; nullptr where there is none that can be read.
std::shared_ptr<const Proof> loadProof(const std::filesystem::path& folder);

/// The last check for drift that was kept there; none where it cannot be read.
std::optional<pipeline::DriftRecord> loadDrift(const std::filesystem::path& folder);
void forgetDrift(const std::filesystem::path& folder);

}  // namespace relucent::gui
