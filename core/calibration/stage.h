// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>
#include <tuple>

#include "relucent/base/enum_names.h"
#include "relucent/calibration/stage_results.h"

namespace relucent::calibration {

/// The stages of a calibration in their order.
enum class Stage { camera, linearization, acquisition, threshold, inverse, clustering, content };

enum class StageKind {
  measured,  // computed from photographs or from the result before
  decided    // somebody looked at a result and decided; the result keeps figures for people
};

/// What the fingerprint of a stage's inputs is made of, see stage_fingerprint.h.
struct StageDescription {
  Stage stage;
  std::string_view name;  // in manifests, in the journal and in names of folders
  StageKind kind;
  std::optional<Stage> predecessor;          // whose result it works on; none: the devices
  std::array<std::string_view, 2> sections;  // of the manifest's settings that it depends on; empty: no more
  int version;  // of its algorithm: one more makes results of the old algorithm out of date
  std::string_view
      choice{};  // a section that only some settings have: the others' fingerprints do not know it
};

/// A description with the type of the stage's result.
template <typename ResultType>
struct StageRecord : StageDescription {
  using Result = ResultType;
};

/// The one table of stages, a record each, in the order of the enumeration.
inline constexpr std::tuple stageTable{
    StageRecord<CameraCheckResult>{{Stage::camera, "camera", StageKind::decided, {}, {}, 1}},
    StageRecord<LinearizationResult>{{Stage::linearization,
                                      "linearization",
                                      StageKind::measured,
                                      Stage::camera,
                                      {"linearization"},
                                      1,
                                      "reduction"}},
    StageRecord<AcquisitionResult>{
        {Stage::acquisition, "acquisition", StageKind::measured, Stage::linearization, {"acquisition"}, 1}},
    StageRecord<ThresholdResult>{
        {Stage::threshold, "threshold", StageKind::decided, Stage::acquisition, {"threshold"}, 1}},
    StageRecord<InverseResult>{
        {Stage::inverse, "inverse", StageKind::measured, Stage::threshold, {"windows", "choose_ridge"}, 1}},
    StageRecord<ClusteringResult>{
        {Stage::clustering, "clustering", StageKind::decided, Stage::threshold, {"clustering"}, 1}},
    StageRecord<ContentResult>{
        {Stage::content, "content", StageKind::decided, Stage::threshold, {"content"}, 1}}};

inline constexpr std::size_t stageCount = std::tuple_size_v<decltype(stageTable)>;

/// The table without its types.
inline constexpr std::array<StageDescription, stageCount> stageDescriptions = std::apply(
    [](const auto&... records) { return std::array{static_cast<const StageDescription&>(records)...}; },
    stageTable);
constexpr const StageDescription& descriptionOf(Stage stage) {
  return stageDescriptions[static_cast<std::size_t>(stage)];
}

inline constexpr std::array<EnumName<Stage>, stageCount> stageNames = std::apply(
    [](const auto&... records) { return std::array{EnumName<Stage>{records.stage, records.name}...}; },
    stageTable);
constexpr EnumNames<Stage> namesOf(Stage) {
  return {"stage", stageNames};
}

static_assert(
    [] {
      for (std::size_t i = 0; i < stageCount; ++i) {
        const StageDescription& stage = stageDescriptions[i];
        if (stage.stage != static_cast<Stage>(i) || stage.version < 1) return false;
        if (stage.predecessor && !(*stage.predecessor < stage.stage)) return false;
      }
      return true;
    }(),
    "records stand in the order of the enumeration, each after its predecessor");

/// What a stage's result says, apart from its files.
template <Stage stage>
using ResultOf = typename std::tuple_element_t<static_cast<std::size_t>(stage), decltype(stageTable)>::Result;

/// The results of all stages, none where a stage was never done.
template <typename Table>
struct OptionalResults;
template <typename... Records>
struct OptionalResults<std::tuple<Records...>> {
  using type = std::tuple<std::optional<typename Records::Result>...>;
};
using StageResults = OptionalResults<std::remove_const_t<decltype(stageTable)>>::type;

}  // namespace relucent::calibration
