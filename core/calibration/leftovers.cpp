// SPDX-License-Identifier: MIT
#include "relucent/calibration/leftovers.h"

#include <algorithm>
#include <set>
#include <string>

#include "relucent/base/file.h"
#include "relucent/base/parsed_json.h"
#include "relucent/calibration/json.h"
#include "relucent/calibration/prepared_files.h"
#include "relucent/calibration/results_json.h"
#include "relucent/calibration/shot_journal.h"

namespace relucent::calibration {
namespace fs = std::filesystem;
namespace {

/// The entries of all stages. The folder is open and locked: its manifest was found sound.
Json resultsIn(const CalibrationFolder& folder) {
  return parsedJson<Json>(readFile(folder.path() / CalibrationFolder::manifestName)).at("results");
}

}  // namespace

bool isManifestLeftover(const std::string& name) {
  return name.starts_with(".calibration.part") && name.ends_with(".relucent");
}

bool isResultLeftover(const std::string& name) {
  return name.starts_with(".") && name.find(".part") != std::string::npos;
}

std::vector<fs::path> leftovers(const CalibrationFolder& folder) {
  std::set<std::string> named;
  for (const Json& entries : resultsIn(folder))
    for (const Json& entry : entries) named.insert(entry.at("folder").get<std::string>());
  std::vector<fs::path> found;
  std::error_code code;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder.path(), code)) {
    const std::string name = entry.path().filename().string();
    if (isManifestLeftover(name)) found.push_back(entry.path());
  }
  for (const fs::directory_entry& entry : fs::directory_iterator(folder.shotFolder(), code))
    if (isShotLeftover(entry.path())) found.push_back(entry.path());
  for (const fs::directory_entry& entry : fs::directory_iterator(folder.path() / "results", code)) {
    const std::string name = entry.path().filename().string();
    const auto isOfStage = [&](Stage stage) { return name.starts_with(std::string(nameOf(stage)) + "-"); };
    const std::vector<Stage> stages = allValues<Stage>();
    if (isBeingPrepared(entry.path())) continue;
    if (isResultLeftover(name) ||
        (std::ranges::any_of(stages, isOfStage) && entry.is_directory(code) && !named.contains(name)))
      found.push_back(entry.path());
  }
  std::ranges::sort(found);
  return found;
}

std::vector<fs::path> replacedResults(const CalibrationFolder& folder) {
  // The folder of a result that was removed may have become that of another since.
  std::set<std::string> found, replaced;
  for (const Json& entries : resultsIn(folder)) {
    std::set<std::string> inputs;
    std::string repaired;  // there is a way back to
    for (auto entry = entries.rbegin(); entry != entries.rend(); ++entry) {
      const auto name = entry->at("folder").get<std::string>();
      const bool isNewest =
          !isSetAside(*entry) && inputs.insert(entry->at("inputs").get<std::string>()).second;
      (isNewest || name == repaired ? found : replaced).insert(name);
      if (isNewest)
        if (const std::optional<RepairNote> repair = repairFrom(entry->at("values"))) repaired = repair->of;
    }
  }
  std::vector<fs::path> folders;
  for (const std::string& name : replaced) {
    std::error_code code;
    const fs::path result = folder.path() / "results" / name;
    if (!name.empty() && !found.contains(name) && fs::is_directory(result, code)) folders.push_back(result);
  }
  return folders;
}

}  // namespace relucent::calibration
