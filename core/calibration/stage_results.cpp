// SPDX-License-Identifier: MIT
#include "relucent/calibration/message_json.h"
#include "relucent/calibration/results.h"
#include "relucent/calibration/results_json.h"
#include "relucent/calibration/stage_fingerprint.h"
#include "relucent/calibration/stage_progress.h"

namespace relucent::calibration {
namespace {

/// Sets `value` where the document has it.
template <typename Value>
void take(const Json& json, const char* key, Value& value) {
  if (json.contains(key)) json.at(key).get_to(value);
}
template <typename Value>
void take(const Json& json, const char* key, std::optional<Value>& value) {
  if (json.contains(key)) value = json.at(key).get<Value>();
}

void take(const Json& json, std::optional<StageCost>& cost) {
  if (!json.contains("cost")) return;
  const Json& stored = json.at("cost");
  cost.emplace();
  take(stored, "seconds", cost->seconds);
  take(stored, "patterns", cost->patterns);
  take(stored, "exposures", cost->exposures);
}

Json toJson(const ImportScore& score) {
  return {{"one_to_one", score.oneToOne}, {"mix", score.mix}, {"transport", score.transport}};
}

Json toJson(const ContentResult& predicted) {
  return {{"reachable", predicted.reachable}, {"delta_e", predicted.deltaE}};
}

ContentResult contentFrom(const Json& values) {
  ContentResult predicted;
  take(values, "reachable", predicted.reachable);
  take(values, "delta_e", predicted.deltaE);
  return predicted;
}

StageResult storeCurrent(CalibrationFolder& folder, Stage stage, Json values) {
  return folder.store(stage, fingerprintOf(folder, stage), std::move(values));
}

template <std::size_t... index>
StageResults resultsOf(const CalibrationFolder& folder, std::index_sequence<index...>) {
  StageResults results;
  const auto readOne = [&]<Stage stage>(std::optional<ResultOf<stage>>& result) {
    if (const std::optional<StageResult> stored = resultOf(folder, stage))
      result = resultFrom<stage>(*stored);
  };
  (readOne.template operator()<static_cast<Stage>(index)>(std::get<index>(results)), ...);
  return results;
}

}  // namespace

Json toJson(const StageCost& cost) {
  Json json{{"seconds", cost.seconds}, {"patterns", cost.patterns}, {"exposures", cost.exposures}};
  if (cost.imported) {
    json["held_out"] = cost.imported->heldOut;
    json["nrmse"] = toJson(*cost.imported);
  }
  return json;
}

Json toJson(const RepairNote& repair) {
  Json json{{"of", repair.of},
            {"what", repair.what},
            {"delta_e_before", repair.deltaEBefore},
            {"delta_e_after", repair.deltaEAfter},
            {"psnr_before", repair.psnrBefore},
            {"psnr_after", repair.psnrAfter},
            {"cost", toJson(repair.cost)}};
  if (repair.contentBefore != repair.contentAfter) {
    json["content_before"] = Json::parse(repair.contentBefore);
    json["content_after"] = Json::parse(repair.contentAfter);
  }
  if (repair.predictedBefore) json["predicted_before"] = toJson(*repair.predictedBefore);
  if (repair.predictedAfter) json["predicted_after"] = toJson(*repair.predictedAfter);
  return json;
}

std::optional<RepairNote> repairFrom(const Json& values) {
  if (!values.contains("repair")) return std::nullopt;
  const Json& stored = values.at("repair");
  RepairNote repair;
  take(stored, "of", repair.of);
  take(stored, "what", repair.what);
  take(stored, "delta_e_before", repair.deltaEBefore);
  take(stored, "delta_e_after", repair.deltaEAfter);
  take(stored, "psnr_before", repair.psnrBefore);
  take(stored, "psnr_after", repair.psnrAfter);
  if (std::optional<StageCost> cost; take(stored, cost), cost) repair.cost = *std::move(cost);
  if (stored.contains("content_before") && stored.contains("content_after")) {
    repair.contentBefore = stored.at("content_before").dump();
    repair.contentAfter = stored.at("content_after").dump();
  }
  if (stored.contains("predicted_before"))
    repair.predictedBefore = contentFrom(stored.at("predicted_before"));
  if (stored.contains("predicted_after")) repair.predictedAfter = contentFrom(stored.at("predicted_after"));
  return repair;
}

Json toJson(const transport::ExpectedQuality& expected) {
  return {{"now", expected.now},
          {"whole", expected.whole},
          {"photographs", expected.photographs},
          {"seconds", expected.seconds}};
}

std::optional<transport::ExpectedQuality> expectedFrom(const Json& values) {
  if (!values.contains("expected_quality")) return std::nullopt;
  const Json& stored = values.at("expected_quality");
  transport::ExpectedQuality expected;
  take(stored, "now", expected.now);
  take(stored, "whole", expected.whole);
  take(stored, "photographs", expected.photographs);
  take(stored, "seconds", expected.seconds);
  return expected;
}

Json toJson(const transport::FoundChange& changed) {
  return {{"what", changed.what}, {"moved", changed.moved}};
}

std::optional<transport::FoundChange> changedFrom(const Json& values) {
  if (!values.contains("changed")) return std::nullopt;
  const Json& stored = values.at("changed");
  transport::FoundChange changed;
  take(stored, "what", changed.what);
  take(stored, "moved", changed.moved);
  return changed;
}

std::vector<Size> sizesFrom(const Json& json) {
  std::vector<Size> sizes;
  for (const Json& size : json) sizes.push_back({size.at(0), size.at(1)});
  return sizes;
}

StageResult storeInverse(CalibrationFolder& folder, const InverseResult& result) {
  Json curve = Json::array();
  for (const InverseResult::Trial& trial : result.curve)
    curve.push_back({{"ridge", trial.ridge}, {"psnr", trial.psnr}});
  Json values = Json::object();
  if (result.ridge) values["ridge"] = *result.ridge;
  values["curve"] = std::move(curve);
  values["bytes"] = result.bytes;
  if (result.cost) values["cost"] = toJson(*result.cost);
  return storeCurrent(folder, Stage::inverse, std::move(values));
}

StageResult storeDecision(CalibrationFolder& folder, const CameraCheckResult& result) {
  Json values{{"exposures", result.exposures}};
  if (result.latencySeconds) {
    values["latency_seconds"] = *result.latencySeconds;
    values["verdicts"] = result.verdicts;
  }
  if (result.tooBright > 0.0) values["too_bright"] = result.tooBright;
  return storeCurrent(folder, Stage::camera, std::move(values));
}

StageResult storeDecision(CalibrationFolder& folder, const ThresholdResult& result) {
  return storeCurrent(folder, Stage::threshold, {{"kept", result.energyKept}, {"leaves", result.leaves}});
}

StageResult storeDecision(CalibrationFolder& folder, const ClusteringResult& result) {
  return storeCurrent(
      folder, Stage::clustering,
      {{"clusters", result.clusters}, {"largest", result.largest}, {"error_median", result.errorMedian}});
}

StageResult storeDecision(CalibrationFolder& folder, const ContentResult& result) {
  return storeCurrent(folder, Stage::content, toJson(result));
}

void read(const StageResult& stored, CameraCheckResult& result) {
  readingJson(stored, [&](const Json& values) {
    take(values, "exposures", result.exposures);
    take(values, "latency_seconds", result.latencySeconds);
    take(values, "verdicts", result.verdicts);
    take(values, "too_bright", result.tooBright);
  });
}

void read(const StageResult& stored, LinearizationResult& result) {
  readingJson(stored, [&](const Json& values) {
    if (values.contains("projectors")) result.projectors = values.at("projectors").size();
    if (values.contains("cameras")) result.cameras = values.at("cameras").size();
    take(values, result.cost);
  });
}

void read(const StageResult& stored, AcquisitionResult& result) {
  readingJson(stored, [&](const Json& values) {
    if (values.contains("projectors")) result.projectors = sizesFrom(values.at("projectors"));
    if (values.contains("cameras")) result.cameras = sizesFrom(values.at("cameras"));
    take(values, "verification_error", result.verificationError);
    take(values, "stopped_at", result.stoppedAt);
    result.expected = expectedFrom(values);
    take(values, "findings", result.findings);
    result.changed = changedFrom(values);
    take(values, "left_out", result.leftOut);
    take(values, "overexposed", result.overexposed);
    take(values, result.cost);
    result.repair = repairFrom(values);
  });
}

void read(const StageResult& stored, ThresholdResult& result) {
  readingJson(stored, [&](const Json& values) {
    take(values, "kept", result.energyKept);
    take(values, "leaves", result.leaves);
  });
}

void read(const StageResult& stored, InverseResult& result) {
  readingJson(stored, [&](const Json& values) {
    take(values, "ridge", result.ridge);
    take(values, "bytes", result.bytes);
    take(values, result.cost);
    if (!values.contains("curve")) return;
    for (const Json& trial : values.at("curve")) {
      InverseResult::Trial& kept = result.curve.emplace_back();
      take(trial, "ridge", kept.ridge);
      take(trial, "psnr", kept.psnr);
    }
  });
}

void read(const StageResult& stored, ClusteringResult& result) {
  readingJson(stored, [&](const Json& values) {
    take(values, "clusters", result.clusters);
    take(values, "largest", result.largest);
    take(values, "error_median", result.errorMedian);
  });
}

void read(const StageResult& stored, ContentResult& result) {
  readingJson(stored, [&](const Json& values) { result = contentFrom(values); });
}

StageResults resultsIn(const CalibrationFolder& folder) {
  return resultsOf(folder, std::make_index_sequence<stageCount>{});
}

}  // namespace relucent::calibration
