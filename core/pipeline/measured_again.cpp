// SPDX-License-Identifier: MIT
#include "relucent/pipeline/measured_again.h"

#include <charconv>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "relucent/base/error.h"
#include "relucent/base/file.h"
#include "relucent/calibration/json.h"
#include "relucent/calibration/stage_fingerprint.h"
#include "relucent/pipeline/stored_settings.h"

namespace relucent::pipeline {
namespace fs = std::filesystem;
namespace {

using calibration::CalibrationFolder;
using calibration::Json;
using calibration::Stage;

constexpr const char* asideName = "earlier-";
constexpr int mostAgain = 100;  // times that one measures again without a result

fs::path asideFolder(const fs::path& journal, int number) {
  return journal / (asideName + std::to_string(number));
}

fs::path unusedFolder(const fs::path& journal) {
  for (int number = 1;; ++number) {
    fs::path folder = asideFolder(journal, number);
    std::error_code code;
    if (!fs::exists(folder, code)) return folder;
  }
}

/// The folders of what was set aside, the newest first.
std::vector<fs::path> asideFolders(const fs::path& journal) {
  std::vector<std::pair<int, fs::path>> found;
  std::error_code code;
  for (const fs::directory_entry& entry : fs::directory_iterator(journal, code)) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with(asideName)) continue;
    const char* digits = name.c_str() + std::string_view(asideName).size();
    int number = 0;
    if (std::from_chars(digits, name.c_str() + name.size(), number).ec == std::errc())
      found.emplace_back(number, entry.path());
  }
  std::ranges::sort(found, std::greater());
  std::vector<fs::path> folders;
  for (auto& [number, folder] : found) folders.push_back(std::move(folder));
  return folders;
}

std::vector<fs::path> shotsOf(Stage stage, const fs::path& folder) {
  const std::string begin = fmt::format("{}-", nameOf(stage));
  std::vector<fs::path> shots;
  std::error_code code;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, code))
    if (entry.is_regular_file(code) && entry.path().filename().string().starts_with(begin))
      shots.push_back(entry.path());
  return shots;
}

void move(const std::vector<fs::path>& shots, const fs::path& to) {
  for (const fs::path& shot : shots) {
    std::error_code code;
    fs::rename(shot, to / shot.filename(), code);
    if (code)
      throw Error(ErrorKind::disk,
                  RELUCENT_MESSAGE("calibration.cannot-move-photograph", "a photograph cannot be moved ({})")
                      .with(code.message()),
                  RELUCENT_MESSAGE("calibration.allow-writing-then-retry",
                                   "check that the folder may be written to, then try again"),
                  shot.string());
  }
}

std::uint64_t seedOf(const CalibrationFolder& folder, Stage stage) {
  const CalibrateSettings settings = settingsOf(folder);
  return stage == Stage::linearization ? settings.linearization.seed : settings.acquisition.seed;
}

Json withSeed(const CalibrationFolder& folder, Stage stage, std::uint64_t seed) {
  Json settings = folder.settings();
  settings[std::string(nameOf(stage))]["seed"] = seed;
  return settings;
}

/// What a result of the stage is made of with a seed.
std::function<std::string(std::uint64_t)> inputsBySeed(const CalibrationFolder& folder, Stage stage) {
  const calibration::StageDescription& description = calibration::descriptionOf(stage);
  const std::string before = calibration::fingerprintOf(folder, description.predecessor.value());
  return [&folder, &description, stage, before](std::uint64_t seed) {
    return calibration::fingerprintAfter(before, description, withSeed(folder, stage, seed));
  };
}

/// The settings that the result was measured with which was in use last, of those whose settings differ from
/// those of now by their seed.
std::optional<Json> earlierSettings(const CalibrationFolder& folder, Stage stage) {
  const std::vector<std::string> results = folder.inputsOf(stage);
  if (results.empty()) return std::nullopt;
  const auto inputsWith = inputsBySeed(folder, stage);
  std::map<std::string, std::uint64_t> seeds;
  std::uint64_t seed = seedOf(folder, stage);
  for (int again = 0; again < mostAgain && seed-- > 0; ++again) seeds.emplace(inputsWith(seed), seed);
  for (const std::string& inputs : results)
    if (const auto found = seeds.find(inputs); found != seeds.end())
      return withSeed(folder, stage, found->second);
  return std::nullopt;
}

}  // namespace

void setShotsAside(const CalibrationFolder& folder, Stage stage) {
  const std::vector<fs::path> shots = shotsOf(stage, folder.shotFolder());
  if (shots.empty()) return;
  const fs::path aside = unusedFolder(folder.shotFolder());
  createFolder(aside);
  move(shots, aside);
}

void measureAgain(CalibrationFolder& folder, Stage stage) {
  setShotsAside(folder, stage);
  // Not the seed of one that was gone back from.
  std::uint64_t seed = seedOf(folder, stage) + 1;
  const auto inputsWith = inputsBySeed(folder, stage);
  while (folder.isCurrent(stage, inputsWith(seed))) ++seed;
  calibration::keepInUse(folder);
  folder.setSettings(withSeed(folder, stage, seed));
}

bool hasEarlier(const CalibrationFolder& folder, Stage stage) {
  return earlierSettings(folder, stage).has_value();
}

bool mayReturnToEarlier(const CalibrationFolder& folder, Stage stage) {
  return !folder.isCurrent(stage, calibration::fingerprintOf(folder, stage)) && hasEarlier(folder, stage);
}

calibration::StageProgress progressInUse(const CalibrationFolder& folder, Stage stage, Stage again) {
  const calibration::StageProgress progress = calibration::progressOf(folder, stage);
  if (progress != calibration::StageProgress::stale || !mayReturnToEarlier(folder, again)) return progress;
  const std::optional<Json> settings = earlierSettings(folder, again);
  return folder.find(stage, calibration::fingerprintOf(folder, stage, *settings))
             ? calibration::StageProgress::done
             : progress;
}

void returnToEarlier(CalibrationFolder& folder, Stage stage) {
  std::optional<Json> settings = earlierSettings(folder, stage);
  if (!settings) return;
  const std::vector<fs::path> before = asideFolders(folder.shotFolder());
  setShotsAside(folder, stage);
  for (const fs::path& aside : before)
    if (const std::vector<fs::path> shots = shotsOf(stage, aside); !shots.empty()) {
      move(shots, folder.shotFolder());
      break;
    }
  folder.setSettings(*std::move(settings));
  calibration::keepInUse(folder);
}

}  // namespace relucent::pipeline
