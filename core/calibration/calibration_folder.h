// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "relucent/calibration/json_fwd.h"
#include "relucent/calibration/stage.h"
#include "relucent/platform/folder_lock.h"

namespace relucent::calibration {

/// A file that belongs to a stage's result, as it was when it was stored.
struct ResultFile {
  std::string name;
  std::uint64_t bytes = 0;
};

/// What a stage left behind. Never changed once it is stored.
struct StageResult {
  Stage stage = Stage::camera;
  std::string inputs;                  // fingerprint of everything that the stage was given
  std::string stored;                  // when, ISO 8601, UTC
  std::shared_ptr<const Json> values;  // what results.h reads
  std::filesystem::path folder;        // where its files are, absolute or as the calibration was opened
  std::vector<ResultFile> files;       // large results
};

/// A calibration on disk: a folder with a manifest.
///   calibration.relucent      JSON: format, version, software, how the rig is made, settings, results
///   results/<stage>-<n>/      files of the n-th result of a stage
///   shots/                    the journal of photographs, see shot_journal.h
/// Every change is one atomic step; killing the program at any instant leaves the calibration as it was
/// before or after. Results are never changed or deleted: a result whose inputs differ from those asked
/// for is stale and stays, and is current again when the settings are set back.
class CalibrationFolder {
 public:
  using Access = platform::FolderLock::Kind;
  static constexpr int version = 1;
  static constexpr const char* manifestName = "calibration.relucent";

  /// A new calibration, locked for writing. `rig` and `settings` are the pipeline's: how the devices are
  /// made and what each stage was asked for.
  /// Throws: Error{input} if there is a calibration already or the folder holds other things; Error{disk}.
  static CalibrationFolder create(const std::filesystem::path& path, Json rig, Json settings);

  /// A calibration that is there; `path` is its folder or its manifest. Readers may be many, a writer is
  /// alone.
  /// Throws: Error{input} if there is none, Error{format} if it is foreign, damaged or of a newer version,
  /// Error{input} if another program works on it.
  static CalibrationFolder open(const std::filesystem::path& path, Access access);

  const std::filesystem::path& path() const { return path_; }
  const Json& rig() const;
  const Json& settings() const;
  /// What later runs are asked for. Results stay; those that no longer fit become stale by themselves.
  void setSettings(Json settings);
  /// From now on this object reads as if these were the settings; nothing is written. For what looks at a
  /// calibration by another choice than the present one. Contract: it is open for reading.
  void readAs(Json settings);
  /// Other devices. Results stay; all of them become stale by themselves.
  void setRig(Json rig);
  /// The program that made this calibration, and when (ISO 8601, UTC).
  std::string software() const;
  std::string created() const;
  std::filesystem::path shotFolder() const { return path_ / "shots"; }

  /// Stores a result: `writeFiles` writes the large parts into the folder it is given. Only when all of
  /// them are on disk does the manifest name them.
  /// With it, in the same step, these settings, if any.
  /// Throws: Error{disk} and whatever writeFiles throws; the calibration is then as it was.
  StageResult store(Stage stage, const std::string& inputs, Json values,
                    const std::function<void(const std::filesystem::path& folder)>& writeFiles = {},
                    const Json* settings = nullptr);

  /// The newest result of a stage is not found any more, as if there were only those before it. It stays on
  /// the disk until `tidy` removes it. With it, in the same step, these settings, if any. None: nothing
  /// happens.
  void setLatestAside(Stage stage, const Json* settings = nullptr);

  /// The newest result for these inputs counts as the newest of its stage from now on: it is what is used
  /// where there is none for what is asked. None: nothing happens.
  void makeLatest(Stage stage, const std::string& inputs);

  /// The newest result of a stage counts as one for these inputs from now on, whatever it was made of. None:
  /// nothing happens. For copies of a manifest alone: the calibration itself never forgets.
  void takeAsCurrent(Stage stage, const std::string& inputs);

  /// The newest result of a stage for these inputs.
  std::optional<StageResult> find(Stage stage, const std::string& inputs) const;
  /// The newest result of a stage for any inputs: perhaps stale.
  std::optional<StageResult> latest(Stage stage) const;
  bool isCurrent(Stage stage, const std::string& inputs) const;
  /// What the results of a stage were made of, the newest first.
  std::vector<std::string> inputsOf(Stage stage) const;

 private:
  CalibrationFolder(std::filesystem::path path, platform::FolderLock lock, Access access, Json manifest);
  void writeManifest(const Json& manifest) const;
  void replaceManifest(Json manifest);
  void changeLatest(Stage stage, const std::function<void(Json& entry)>& change,
                    const Json* settings = nullptr);
  StageResult resultFrom(Stage stage, const Json& entry) const;
  /// Oldest first, without those that are set aside.
  std::vector<const Json*> entriesOf(Stage stage) const;

  std::filesystem::path path_;
  platform::FolderLock lock_;
  Access access_;
  std::shared_ptr<const Json> manifest_;
};

/// Where a file of a result is, after a look at its size.
/// Throws: Error{format} if it is missing or not as long as it was when it was stored.
std::filesystem::path fileOf(const StageResult& result, const std::string& name);

}  // namespace relucent::calibration
