// SPDX-License-Identifier: MIT
#include "relucent/pipeline/surprises_file.h"

#include "relucent/base/error.h"
#include "relucent/base/file.h"
#include "relucent/base/parsed_json.h"
#include "relucent/calibration/enum_json.h"

namespace relucent::pipeline {

using calibration::Json;
using venue::Surprise;

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
    settings.patterns = json.at("patterns").get<int>();
    settings.shift = json.at("shift").get<double>();
    settings.degrees = json.at("degrees").get<double>();
    settings.roomLight = json.at("room_light").get<double>();
    settings.failures = json.at("failures").get<int>();
    return std::make_shared<venue::Surprises>(
        settings,
        venue::SurprisesSoFar{json.at("lasting").get<std::vector<Surprise>>(),
                              json.at("over").get<std::vector<Surprise>>(),
                              json.at("failures_so_far").get<int>(), json.at("looks_so_far").get<int>()});
  } catch (const Json::exception&) {
    return nullptr;
  } catch (const Error&) {
    return nullptr;
  }
}

}  // namespace relucent::pipeline
