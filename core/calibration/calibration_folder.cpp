// SPDX-License-Identifier: MIT
#include "relucent/calibration/calibration_folder.h"

#include <algorithm>
#include <chrono>
#include <set>
#include <thread>

#include "relucent/base/error.h"
#include "relucent/base/file.h"
#include "relucent/base/file_name.h"
#include "relucent/base/parsed_json.h"
#include "relucent/base/utc.h"
#include "relucent/calibration/json.h"
#include "relucent/calibration/leftovers.h"
#include "relucent/calibration/prepared_files.h"
#include "relucent/calibration/results_json.h"
#include "relucent/platform/files.h"

#ifndef RELUCENT_VERSION
#define RELUCENT_VERSION "development"
#endif

namespace relucent::calibration {
namespace fs = std::filesystem;
namespace {

constexpr const char* calibrationFormat = "relucent calibration";

void removeLeftovers(const fs::path& folder, bool (*isLeftover)(const std::string& name)) {
  std::error_code ignored;
  std::vector<fs::path> leftovers;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored))
    if (isLeftover(entry.path().filename().string()) && !isBeingPrepared(entry.path()))
      leftovers.push_back(entry.path());
  for (const fs::path& path : leftovers) fs::remove_all(path, ignored);
}

bool holdsAnything(const fs::path& folder) {
  std::error_code code;
  fs::directory_iterator entries(folder, code);
  if (code)
    throw Error(ErrorKind::disk,
                RELUCENT_MESSAGE("calibration.cannot-list-folder", "cannot look into the folder ({})")
                    .with(code.message()),
                RELUCENT_MESSAGE("calibration.check-permission-or-name",
                                 "check that you may read it, or choose another name"),
                folder.string());
  return std::any_of(begin(entries), end(entries), [](const fs::directory_entry& entry) {
    return !isManifestLeftover(entry.path().filename().string());
  });
}

/// Whoever looks into a calibration while it plays does so for milliseconds: a writer waits for him.
platform::FolderLock lockedSoon(const fs::path& folder, CalibrationFolder::Access access) {
  constexpr auto patience = std::chrono::milliseconds(80), pause = std::chrono::milliseconds(5);
  const auto end = std::chrono::steady_clock::now() + patience;
  while (true) {
    try {
      return {folder, access};
    } catch (const std::system_error& failure) {
      if (access != CalibrationFolder::Access::write || failure.code() != std::errc::operation_would_block ||
          std::chrono::steady_clock::now() > end)
        throw;
    }
    std::this_thread::sleep_for(pause);
  }
}

/// Throws: Error{input} if another program holds a lock that excludes this one; Error{disk} if the folder
/// cannot be opened.
platform::FolderLock locked(const fs::path& folder, CalibrationFolder::Access access) try {
  return lockedSoon(folder, access);
} catch (const std::system_error& failure) {
  if (failure.code() == std::errc::operation_would_block)
    throw Error(
        ErrorKind::input,
        RELUCENT_ENGLISH_MESSAGE("calibration.in-use", "another program is working on this calibration"),
        RELUCENT_ENGLISH_MESSAGE("calibration.wait-or-close-other-program",
                                 "wait until it has finished, or close it, then try again"),
        folder.string());
  throw Error(
      ErrorKind::disk,
      RELUCENT_MESSAGE("calibration.cannot-open-folder", "cannot open the folder ({})")
          .with(failure.code().message()),
      RELUCENT_MESSAGE("calibration.check-path-and-permission", "check the path and that you may read it"),
      folder.string());
}

void checkSynced(const platform::FileOutcome& outcome, const fs::path& path) {
  if (outcome.code)
    throw Error(ErrorKind::disk,
                RELUCENT_MESSAGE("disk.cannot-write", "cannot write ({})").with(outcome.code.message()),
                RELUCENT_MESSAGE("disk.free-space-or-check-disk",
                                 "free some space there or check the disk, then try again"),
                path.string());
}

Error damaged(const fs::path& manifest, const Message& what) {
  return Error(ErrorKind::format, what,
               RELUCENT_MESSAGE("calibration.choose-another-or-copy-again",
                                "choose another calibration, or copy it again from where it was measured"),
               manifest.string());
}

/// The manifest, with everything that this class later takes for granted.
Json readManifest(const fs::path& file) {
  Json manifest;
  try {
    manifest = parsedJson<Json>(readFile(file));
  } catch (const Json::exception&) {  // nothing, and so no manifest
  }
  if (!manifest.is_object())
    throw damaged(file, RELUCENT_MESSAGE("calibration.manifest-damaged",
                                         "the file that describes the venue is damaged"));
  if (manifest.value("format", Json()) != calibrationFormat)
    throw damaged(file,
                  RELUCENT_MESSAGE("calibration.not-a-calibration", "this is not a calibration of Relucent"));
  Json written = manifest.value("version", Json());
  if (!written.is_number_integer())
    throw damaged(file, RELUCENT_MESSAGE("calibration.manifest-damaged",
                                         "the file that describes the venue is damaged"));
  if (written.get<int>() > CalibrationFolder::version)
    throw Error(ErrorKind::format,
                RELUCENT_ENGLISH_MESSAGE("calibration.of-newer-version",
                                         "the calibration was made by a newer Relucent"),
                RELUCENT_ENGLISH_MESSAGE("calibration.update-relucent",
                                         "open it with that version, or update this one"),
                file.string());

  if (manifest.contains("settings") && manifest["settings"].is_null()) manifest["settings"] = Json::object();
  auto isText = [](const Json& value) { return value.is_string(); };
  // Calibrations come from strangers: what they name lies within them.
  auto isResult = [&](const Json& entry) {
    if (!entry.is_object() || !isText(entry.value("inputs", Json())) ||
        !isText(entry.value("stored", Json())) || !isText(entry.value("folder", Json())) ||
        !entry.contains("values") || !entry.value("files", Json()).is_object())
      return false;
    const auto folder = entry["folder"].get<std::string>();
    if (!folder.empty() && !isFileName(folder)) return false;
    for (const auto& [name, bytes] : entry["files"].items())
      if (!isFileName(name) || !bytes.is_number_unsigned()) return false;
    return true;
  };
  Json results = manifest.value("results", Json());
  bool whole = isText(manifest.value("software", Json())) && isText(manifest.value("created", Json())) &&
               manifest.contains("rig") && manifest.value("settings", Json()).is_object() &&
               results.is_object() && std::all_of(results.begin(), results.end(), [&](const Json& entries) {
                 return entries.is_array() && std::all_of(entries.begin(), entries.end(), isResult);
               });
  if (!whole)
    throw damaged(file, RELUCENT_MESSAGE("calibration.manifest-damaged",
                                         "the file that describes the venue is damaged"));
  return manifest;
}

}  // namespace

CalibrationFolder::CalibrationFolder(fs::path path, platform::FolderLock lock, Access access, Json manifest)
    : path_(std::move(path)),
      lock_(std::move(lock)),
      access_(access),
      manifest_(std::make_shared<const Json>(std::move(manifest))) {}

const Json& CalibrationFolder::rig() const {
  return manifest_->at("rig");
}

const Json& CalibrationFolder::settings() const {
  return manifest_->at("settings");
}

std::string CalibrationFolder::software() const {
  return manifest_->at("software");
}

std::string CalibrationFolder::created() const {
  return manifest_->at("created");
}

CalibrationFolder CalibrationFolder::create(const fs::path& path, Json rig, Json settings) {
  std::error_code code;
  if (fs::exists(path, code) && !fs::is_directory(path, code))
    throw Error(ErrorKind::input,
                RELUCENT_ENGLISH_MESSAGE("calibration.name-is-a-file", "there is a file of this name"),
                RELUCENT_ENGLISH_MESSAGE("calibration.choose-another-name",
                                         "choose another name for the calibration"),
                path.string());
  createFolder(path);
  platform::FolderLock lock = locked(path, Access::write);
  if (fs::exists(path / manifestName, code))
    throw Error(ErrorKind::input,
                RELUCENT_ENGLISH_MESSAGE("calibration.already-exists", "there is a calibration already"),
                RELUCENT_ENGLISH_MESSAGE("calibration.resume-or-choose-another-name",
                                         "go on with it by `resume`, or choose another name"),
                path.string());
  if (holdsAnything(path))
    throw Error(
        ErrorKind::input,
        RELUCENT_ENGLISH_MESSAGE("calibration.folder-holds-other-files", "the folder holds other files"),
        RELUCENT_ENGLISH_MESSAGE("calibration.choose-empty-folder",
                                 "choose a new or an empty folder for the calibration"),
        path.string());

  Json manifest = {
      {"format", calibrationFormat}, {"version", version},    {"software", "Relucent " RELUCENT_VERSION},
      {"created", utcNow()},         {"rig", std::move(rig)}, {"settings", std::move(settings)},
      {"results", Json::object()}};
  CalibrationFolder folder(path, std::move(lock), Access::write, std::move(manifest));
  folder.writeManifest(*folder.manifest_);
  return folder;
}

CalibrationFolder CalibrationFolder::open(const fs::path& given, Access access) {
  fs::path path = given.filename() == manifestName ? given.parent_path() : given;
  if (path.empty()) path = ".";
  std::error_code code;
  if (!fs::is_directory(path, code))
    throw Error(ErrorKind::input,
                RELUCENT_ENGLISH_MESSAGE("calibration.not-found", "there is no such calibration"),
                RELUCENT_ENGLISH_MESSAGE("calibration.check-name-or-calibrate",
                                         "check the name, or make one by `calibrate`"),
                path.string());
  if (!fs::exists(path / manifestName, code))
    throw Error(ErrorKind::input,
                RELUCENT_ENGLISH_MESSAGE("calibration.manifest-missing",
                                         "this folder is not a calibration: it holds no {}")
                    .with(manifestName),
                RELUCENT_ENGLISH_MESSAGE("calibration.check-name-or-calibrate",
                                         "check the name, or make one by `calibrate`"),
                path.string());

  platform::FolderLock lock = locked(path, access);
  Json manifest = readManifest(path / manifestName);
  if (access == Access::write) {
    removeLeftovers(path, isManifestLeftover);
    removeLeftovers(path / "results", isResultLeftover);
  }
  return CalibrationFolder(path, std::move(lock), access, std::move(manifest));
}

void CalibrationFolder::writeManifest(const Json& manifest) const {
  require(access_ == Access::write, "the calibration {} is open for reading", path_.string());
  writeFileAtomically(path_ / manifestName, manifest.dump(1) + "\n");
}

void CalibrationFolder::replaceManifest(Json manifest) {
  writeManifest(manifest);
  manifest_ = std::make_shared<const Json>(std::move(manifest));
}

void CalibrationFolder::setSettings(Json settings) {
  Json manifest = *manifest_;
  manifest["settings"] = std::move(settings);
  replaceManifest(std::move(manifest));
}

void CalibrationFolder::readAs(Json settings) {
  require(access_ == Access::read, "the calibration {} is open for writing", path_.string());
  Json manifest = *manifest_;
  manifest["settings"] = std::move(settings);
  manifest_ = std::make_shared<const Json>(std::move(manifest));
}

void CalibrationFolder::setRig(Json rig) {
  Json manifest = *manifest_;
  manifest["rig"] = std::move(rig);
  replaceManifest(std::move(manifest));
}

void CalibrationFolder::takeAsCurrent(Stage stage, const std::string& inputs) {
  changeLatest(stage, [&](Json& entry) { entry["inputs"] = inputs; });
}

void CalibrationFolder::makeLatest(Stage stage, const std::string& inputs) {
  Json manifest = *manifest_;
  const auto found = manifest["results"].find(std::string(nameOf(stage)));
  if (found == manifest["results"].end()) return;
  Json::array_t& entries = found->get_ref<Json::array_t&>();
  const auto isOther = [&](const Json& entry) { return isSetAside(entry) || entry.at("inputs") != inputs; };
  const auto newest = std::find_if_not(entries.rbegin(), entries.rend(), isOther);
  if (newest == entries.rend() || newest == entries.rbegin()) return;
  std::rotate(newest.base() - 1, newest.base(), entries.end());
  replaceManifest(std::move(manifest));
}

void CalibrationFolder::setLatestAside(Stage stage, const Json* settings) {
  changeLatest(stage, [](Json& entry) { entry[setAsideKey] = true; }, settings);
}

void CalibrationFolder::changeLatest(Stage stage, const std::function<void(Json& entry)>& change,
                                     const Json* settings) {
  Json manifest = *manifest_;
  auto entries = manifest["results"].find(std::string(nameOf(stage)));
  if (entries == manifest["results"].end()) return;
  const auto latest = std::find_if_not(entries->rbegin(), entries->rend(), isSetAside);
  if (latest == entries->rend()) return;
  change(*latest);
  if (settings != nullptr) manifest["settings"] = *settings;
  replaceManifest(std::move(manifest));
}

StageResult CalibrationFolder::store(Stage stage, const std::string& inputs, Json values,
                                     const std::function<void(const fs::path&)>& writeFiles,
                                     const Json* settings) {
  require(access_ == Access::write, "the calibration {} is open for reading", path_.string());
  Json files = Json::object();
  std::string name;
  if (writeFiles) {
    fs::path results = path_ / "results";
    createFolder(results);
    std::set<std::string> taken;
    for (const Json& entry : (*manifest_)["results"].value(std::string(nameOf(stage)), Json::array()))
      taken.insert(entry.at("folder").get<std::string>());
    int number = 1;
    const auto folderOf = [&] { return fmt::format("{}-{}", nameOf(stage), number); };
    while (taken.contains(folderOf()) && fs::exists(results / folderOf())) ++number;
    name = folderOf();
    fs::path temporary = results / ("." + name + ".part");

    try {
      createFolder(temporary);
      writeFiles(temporary);
      syncFilesIn(temporary);
      for (const fs::directory_entry& entry : fs::directory_iterator(temporary))
        files[entry.path().filename().string()] = entry.file_size();
      // A folder without an entry is what a program that died before its last step left: nobody reads it.
      fs::remove_all(results / name);
      fs::rename(temporary, results / name);
      checkSynced(platform::syncFolder(results), results);
    } catch (const fs::filesystem_error& error) {
      removeLeftovers(results, isResultLeftover);
      throw Error(ErrorKind::disk,
                  RELUCENT_MESSAGE("disk.cannot-write", "cannot write ({})").with(error.code().message()),
                  RELUCENT_MESSAGE("disk.free-space-or-check-disk",
                                   "free some space there or check the disk, then try again"),
                  results.string());
    } catch (...) {
      removeLeftovers(results, isResultLeftover);
      throw;
    }
  }

  Json manifest = *manifest_;
  Json entry = {{"inputs", inputs},
                {"stored", utcNow()},
                {"folder", name},
                {"values", std::move(values)},
                {"files", std::move(files)}};
  manifest["results"][std::string(nameOf(stage))].push_back(std::move(entry));
  if (settings != nullptr) manifest["settings"] = *settings;
  replaceManifest(std::move(manifest));
  return *latest(stage);
}

StageResult CalibrationFolder::resultFrom(Stage stage, const Json& entry) const {
  StageResult result{stage,
                     entry.at("inputs"),
                     entry.at("stored"),
                     std::make_shared<const Json>(entry.at("values")),
                     path_ / "results" / entry.at("folder").get<std::string>(),
                     {}};
  for (const auto& [name, bytes] : entry.at("files").items()) result.files.push_back({name, bytes});
  return result;
}

std::vector<const Json*> CalibrationFolder::entriesOf(Stage stage) const {
  const Json& results = manifest_->at("results");
  const auto entries = results.find(std::string(nameOf(stage)));
  std::vector<const Json*> found;
  if (entries == results.end()) return found;
  for (const Json& entry : *entries)
    if (!isSetAside(entry)) found.push_back(&entry);
  return found;
}

std::optional<StageResult> CalibrationFolder::find(Stage stage, const std::string& inputs) const {
  const std::vector<const Json*> entries = entriesOf(stage);
  for (auto entry = entries.rbegin(); entry != entries.rend(); ++entry)
    if ((*entry)->at("inputs") == inputs) return resultFrom(stage, **entry);
  return std::nullopt;
}

std::optional<StageResult> CalibrationFolder::latest(Stage stage) const {
  const std::vector<const Json*> entries = entriesOf(stage);
  return entries.empty() ? std::nullopt : std::optional(resultFrom(stage, *entries.back()));
}

bool CalibrationFolder::isCurrent(Stage stage, const std::string& inputs) const {
  return find(stage, inputs).has_value();
}

std::vector<std::string> CalibrationFolder::inputsOf(Stage stage) const {
  std::vector<std::string> inputs;
  for (const Json* entry : entriesOf(stage)) inputs.push_back(entry->at("inputs"));
  std::ranges::reverse(inputs);
  return inputs;
}

fs::path fileOf(const StageResult& result, const std::string& name) {
  auto file = std::find_if(result.files.begin(), result.files.end(),
                           [&](const ResultFile& candidate) { return candidate.name == name; });
  fs::path path = result.folder / name;
  std::error_code code;
  std::uint64_t bytes = fs::file_size(path, code);
  if (file == result.files.end() || code)
    throw damaged(
        path, RELUCENT_MESSAGE("calibration.result-file-missing", "a file of the calibration's {} is missing")
                  .with(nameOf(result.stage)));
  if (bytes != file->bytes)
    throw damaged(path, RELUCENT_MESSAGE("calibration.result-file-size-wrong",
                                         "a file of the calibration's {} has {} bytes instead of {}")
                            .with(nameOf(result.stage), as::bytes(bytes), file->bytes));
  return path;
}

}  // namespace relucent::calibration
