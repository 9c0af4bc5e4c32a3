// SPDX-License-Identifier: MIT
#include "relucent/pipeline/kept_photographs.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "relucent/base/error.h"
#include "relucent/calibration/enum_json.h"
#include "relucent/calibration/results.h"
#include "relucent/calibration/stage_progress.h"

namespace relucent::pipeline {
namespace fs = std::filesystem;
namespace {

using calibration::CalibrationFolder;
using calibration::Json;
using calibration::Stage;

/// In a manifest's settings; no fingerprint knows either.
constexpr const char* keptSection = "kept_photographs";
constexpr const char* removedSection = "photographs_removed";  // the result without any, by its folder
constexpr Stage photographed[]{Stage::linearization, Stage::acquisition};

bool isShot(const fs::directory_entry& entry) {
  const std::string name = entry.path().filename().string();
  std::error_code code;
  return name.ends_with(".shot") && entry.is_regular_file(code) && !entry.is_symlink(code) &&
         std::ranges::any_of(
             photographed, [&](Stage stage) { return name.starts_with(fmt::format("{}-", nameOf(stage))); });
}

/// Those in this folder itself, the last first.
std::vector<fs::path> shotsIn(const fs::path& folder) {
  std::vector<fs::path> shots;
  std::error_code code;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, code))
    if (isShot(entry)) shots.push_back(entry.path());
  std::ranges::sort(shots, std::greater());
  return shots;
}

/// Where setShotsAside() puts them.
std::vector<fs::path> asideFolders(const CalibrationFolder& folder) {
  std::vector<fs::path> aside;
  std::error_code code;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder.shotFolder(), code))
    if (entry.path().filename().string().starts_with("earlier-") && entry.is_directory(code) &&
        !entry.is_symlink(code))
      aside.push_back(entry.path());
  std::ranges::sort(aside);
  return aside;
}

/// The result that follows from the photographs, by the name of its folder: no two have the same.
std::string lightTransportOf(const CalibrationFolder& folder) {
  const auto result = resultOf(folder, Stage::acquisition);
  return result ? result->folder.filename().string() : std::string();
}

void tellRemoved(CalibrationFolder& folder) {
  if (werePhotographsRemoved(folder)) return;
  Json settings = folder.settings();
  settings[removedSection] = lightTransportOf(folder);
  folder.setSettings(std::move(settings));
}

}  // namespace

KeptPhotographs keptPhotographs(const CalibrationFolder& folder) {
  const Json& settings = folder.settings();
  if (!settings.contains(keptSection)) return KeptPhotographs::everything;
  const Json& kept = settings.at(keptSection);
  return parsedName<KeptPhotographs>(kept.is_string() ? kept.get<std::string>() : kept.dump(),
                                     ErrorKind::format);
}

void keepPhotographs(CalibrationFolder& folder, KeptPhotographs kept) {
  if (keptPhotographs(folder) == kept) return;
  Json settings = folder.settings();
  settings[keptSection] = nameOf(kept);
  folder.setSettings(std::move(settings));
}

bool isComplete(const CalibrationFolder& folder) {
  const auto measured = currentResultOf(folder, Stage::acquisition);
  return measured && currentResultOf(folder, Stage::linearization) &&
         calibration::resultFrom<Stage::acquisition>(*measured).isWhole();
}

std::vector<fs::path> removablePhotographs(const CalibrationFolder& folder, KeptPhotographs kept) {
  if (kept == KeptPhotographs::everything || !isComplete(folder)) return {};
  std::vector<fs::path> removable;
  for (const fs::path& aside : asideFolders(folder))
    std::ranges::copy(shotsIn(aside), std::back_inserter(removable));
  if (kept == KeptPhotographs::results)
    std::ranges::copy(shotsIn(folder.shotFolder()), std::back_inserter(removable));
  return removable;
}

DiskShare removePhotographs(CalibrationFolder& folder, KeptPhotographs kept) {
  const std::vector<fs::path> removable = removablePhotographs(folder, kept);
  if (removable.empty()) return {};
  if (kept == KeptPhotographs::results) tellRemoved(folder);
  DiskShare removed;
  for (const fs::path& shot : removable) {
    std::error_code code;
    const std::uint64_t bytes = fs::file_size(shot, code);
    if (!code) fs::remove(shot, code);
    if (code)
      throw Error(
          ErrorKind::disk,
          RELUCENT_MESSAGE("calibration.cannot-remove-photograph", "a photograph cannot be removed ({})")
              .with(code.message()),
          RELUCENT_MESSAGE("calibration.allow-writing-then-retry",
                           "check that the folder may be written to, then try again"),
          shot.string());
    ++removed.files;
    removed.bytes += bytes;
  }
  std::error_code ignored;  // other things in such a folder keep it
  for (const fs::path& aside : asideFolders(folder)) fs::remove(aside, ignored);
  return removed;
}

DiskShare removePhotographs(CalibrationFolder& folder) {
  return removePhotographs(folder, keptPhotographs(folder));
}

bool werePhotographsRemoved(const CalibrationFolder& folder) {
  return folder.settings().value(removedSection, Json()) == lightTransportOf(folder);
}

}  // namespace relucent::pipeline
