// SPDX-License-Identifier: MIT
#include "relucent/pipeline/surprises_file.h"

#include <optional>

#include "relucent/base/error.h"
#include "relucent/base/file.h"
#include "relucent/base/parsed_json.h"
#include "relucent/calibration/enum_json.h"

namespace relucent::pipeline {

using calibration::Json;
using venue::Surprise;

namespace {

constexpr int mostPhotographs = 10'000'000;  // a year of them, three seconds each

/// A count of photographs that a rehearsal can come to; none: anything else.
std::optional<int> countOf(const Json& json) {
  if (!json.is_number_integer() || json < 0 || json > mostPhotographs) return std::nullopt;
  return json.get<int>();
}

}  // namespace

void saveSurprises(const venue::Surprises& surprises, const std::filesystem::path& folder) {
  const venue::SurpriseSettings& settings = surprises.settings();
  const venue::SurprisesSoFar now = surprises.soFar();
  const Json json{
      {"kinds", settings.kinds},         {"seed", settings.seed},       {"patterns", settings.patterns},
      {"shift", settings.shift},         {"degrees", settings.degrees}, {"room_light", settings.roomLight},
      {"failures", settings.failures},   {"lasting", now.lasting},      {"over", now.over},
      {"failures_so_far", now.failures}, {"looks_so_far", now.looks}};
  writeFileAtomically(folder / surprisesName, json.dump(2));
}

std::shared_ptr<venue::Surprises> loadSurprises(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / surprisesName;
  if (!std::filesystem::exists(file)) return nullptr;
  try {
    const Json json = parsedJson<Json>(readFile(file));
    venue::SurpriseSettings settings;
    settings.kinds = json.at("kinds").get<std::vector<Surprise>>();
    settings.seed = json.at("seed").get<std::uint64_t>();
    const std::optional<int> patterns = countOf(json.at("patterns")), failures = countOf(json.at("failures")),
                             failed = countOf(json.at("failures_so_far")),
                             looks = countOf(json.at("looks_so_far"));
    if (!patterns || !failures || !failed || !looks) return nullptr;
    settings.patterns = *patterns;
    settings.failures = *failures;
    settings.shift = json.at("shift").get<double>();
    settings.degrees = json.at("degrees").get<double>();
    settings.roomLight = json.at("room_light").get<double>();
    return std::make_shared<venue::Surprises>(
        settings, venue::SurprisesSoFar{json.at("lasting").get<std::vector<Surprise>>(),
                                        json.at("over").get<std::vector<Surprise>>(), *failed, *looks});
  } catch (const Json::exception&) {
    return nullptr;
  } catch (const Error&) {
    return nullptr;
  }
}

}  // namespace relucent::pipeline
