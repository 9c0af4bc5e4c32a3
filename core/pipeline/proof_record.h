// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "relucent/calibration/calibration_folder.h"
#include "relucent/pipeline/content_settings.h"
#include "relucent/pipeline/drift_record.h"
#include "relucent/pipeline/prove.h"

namespace relucent::pipeline {

/// What is kept of a verification photograph beside its pictures: figures, time, and what it was taken of.
struct ProofRecord {
  std::string taken;        // ISO 8601, UTC
  std::string measurement;  // when the light transport was measured that it belongs to
  std::string shownFrom{};  // see fingerprintOfShown(); empty in records of earlier versions
  ContentSettings content;
  ProveResult figures;    // method, before, after, reachable, moved
  std::string picture{};  // file or resource; empty: nobody kept it
};

/// A fingerprint of all that a picture is corrected with if the calibration is read now: the measurement that
/// is used, also while another one has begun, threshold, windows and clusters. What was read when it was
/// another one corrects as of then.
std::string fingerprintOfCorrection(const calibration::CalibrationFolder& folder);

/// The same with how content is shown, whichever it is: all that a picture on the projectors follows from.
/// With another one a photograph says nothing of what is shown now, and a show that was opened before does
/// not show it.
std::string fingerprintOfShown(const calibration::CalibrationFolder& folder);
/// The same of content that is shown so there, whatever the calibration's is now.
std::string fingerprintOfShown(const calibration::CalibrationFolder& folder, const ContentSettings& shown);

/// Whether the photograph was taken of what is shown now; records of earlier versions are taken at their
/// word.
bool isOfShown(const ProofRecord& record, const calibration::CalibrationFolder& folder);

/// Whether a photograph answers what a check for drift found: it was taken later, of the same measurement,
/// and is of what is shown now or was as predicted. Where camera and projector stand is not the content's.
bool answers(const ProofRecord& proof, bool isOfShown, const DriftRecord& drift);

/// Writes proof.json into a folder. Throws: Error{disk}.
void saveProofRecord(const ProofRecord& record, const std::filesystem::path& folder);

/// None where the folder holds no proof.json. Throws: Error{disk, format} if it cannot be read.
std::optional<ProofRecord> loadProofRecord(const std::filesystem::path& folder);

}  // namespace relucent::pipeline
