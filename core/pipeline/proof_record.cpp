// SPDX-License-Identifier: MIT
#include "relucent/pipeline/proof_record.h"

#include "relucent/base/error.h"
#include "relucent/base/file.h"
#include "relucent/base/fingerprint.h"
#include "relucent/base/parsed_json.h"
#include "relucent/calibration/enum_json.h"
#include "relucent/calibration/stage_progress.h"
#include "relucent/pipeline/picture_error_json.h"
#include "relucent/pipeline/settings_json.h"
#include "relucent/pipeline/stored_settings.h"

namespace relucent::pipeline {
namespace {

namespace fs = std::filesystem;

constexpr const char* fileName = "proof.json";

calibration::Json toJson(const ProvedProjection& projection) {
  return {{"predicted", projection.predicted},
          {"measured", projection.measured},
          {"surprise", projection.surprise},
          {"worst_patch", projection.worstPatch},
          {"worst_place", projection.worstPlace}};
}
ProvedProjection projectionFrom(const calibration::Json& json) {
  // Records of earlier versions have no patch.
  return {json.at("predicted").get<PictureError>(), json.at("measured").get<PictureError>(),
          json.at("surprise").get<double>(), json.value("worst_patch", 0.0),
          json.value("worst_place", std::array<double, 2>{})};
}

calibration::Json toJson(const sentinels::Movement& moved) {
  return {{"x", moved.x}, {"y", moved.y}, {"degrees", moved.degrees}, {"explains", moved.explains}};
}
/// Records of earlier versions have none.
sentinels::Movement movementFrom(const calibration::Json& json) {
  if (!json.contains("moved")) return {};
  const calibration::Json& moved = json.at("moved");
  return {moved.at("x").get<double>(), moved.at("y").get<double>(), moved.at("degrees").get<double>(),
          moved.at("explains").get<bool>()};
}

calibration::Json toJson(const ProvedView& view) {
  return {{"before", toJson(view.before)},
          {"after", toJson(view.after)},
          {"reachable", view.reachable},
          {"moved", toJson(view.moved)}};
}
ProvedView viewFrom(const calibration::Json& json) {
  return {projectionFrom(json.at("before")), projectionFrom(json.at("after")),
          json.at("reachable").get<double>(), movementFrom(json)};
}

}  // namespace

std::string fingerprintOfCorrection(const calibration::CalibrationFolder& folder) {
  using calibration::Stage;
  calibration::Json read = calibration::Json::array();
  for (Stage measured : {Stage::linearization, Stage::acquisition})
    if (const std::optional<calibration::StageResult> result = calibration::resultOf(folder, measured))
      read.push_back({result->stored, result->folder.filename().string()});
  const calibration::Json& settings = folder.settings();
  for (Stage chosen : {Stage::threshold, Stage::inverse, Stage::clustering}) {
    const calibration::StageDescription& stage = calibration::descriptionOf(chosen);
    read.push_back({stage.name, stage.version});
    for (std::string_view section : stage.sections)
      if (const std::string name(section); settings.contains(name)) read.push_back({name, settings.at(name)});
  }
  return Fingerprint().add(read.dump()).hex();
}

std::string fingerprintOfShown(const calibration::CalibrationFolder& folder, const ContentSettings& shown) {
  ContentSettings content = shown;
  content.picture.clear();
  const calibration::Json json{{"content", contentToJson(content)}};
  return Fingerprint().add(fingerprintOfCorrection(folder)).add(json.dump()).hex();
}

std::string fingerprintOfShown(const calibration::CalibrationFolder& folder) {
  return fingerprintOfShown(folder, settingsOf(folder).content);
}

bool isOfShown(const ProofRecord& record, const calibration::CalibrationFolder& folder) {
  return record.shownFrom.empty() || record.shownFrom == fingerprintOfShown(folder);
}

bool answers(const ProofRecord& proof, bool isOfShown, const DriftRecord& drift) {
  return proof.measurement == drift.measurement && (isOfShown || isAsPredicted(proof.figures)) &&
         drift.checked < proof.taken;
}

void saveProofRecord(const ProofRecord& record, const fs::path& folder) {
  calibration::Json json{{"taken", record.taken},
                         {"measurement", record.measurement},
                         {"shown_from", record.shownFrom},
                         {"settings", {{"content", contentToJson(record.content)}}},
                         {"method", record.figures.method},
                         {"before", toJson(record.figures.before)},
                         {"after", toJson(record.figures.after)},
                         {"reachable", record.figures.reachable},
                         {"moved", toJson(record.figures.moved)},
                         {"picture", record.picture}};
  for (const ProvedView& view : record.figures.others) json["other_views"].push_back(toJson(view));
  writeFileAtomically(folder / fileName, json.dump(2));
}

std::optional<ProofRecord> loadProofRecord(const fs::path& folder) {
  if (!fs::exists(folder / fileName)) return std::nullopt;
  try {
    const calibration::Json json = parsedJson<calibration::Json>(readFile(folder / fileName));
    ProofRecord record;
    record.taken = json.at("taken").get<std::string>();
    record.measurement = json.at("measurement").get<std::string>();
    record.shownFrom = json.value("shown_from", std::string());
    record.content = contentFromJson(json.at("settings").at("content"));
    record.figures.method = json.at("method").get<compensation::Method>();
    record.figures.before = projectionFrom(json.at("before"));
    record.figures.after = projectionFrom(json.at("after"));
    record.figures.reachable = json.at("reachable").get<double>();
    record.figures.moved = movementFrom(json);
    record.picture = json.value("picture", std::string());
    if (json.contains("other_views"))
      for (const calibration::Json& view : json.at("other_views"))
        record.figures.others.push_back(viewFrom(view));
    return record;
  } catch (const calibration::Json::exception& cause) {
    throw Error(ErrorKind::format,
                RELUCENT_ENGLISH_MESSAGE("proof.record-unreadable",
                                         "the record of the verification photograph cannot be read ({})")
                    .with(cause.what()),
                RELUCENT_ENGLISH_MESSAGE("proof.take-photograph-again", "take the photograph again"),
                (folder / fileName).string());
  }
}

}  // namespace relucent::pipeline
