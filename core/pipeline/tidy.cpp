// SPDX-License-Identifier: MIT
#include "relucent/pipeline/tidy.h"

#include <algorithm>
#include <cstring>

#include "relucent/base/error.h"
#include "relucent/base/file.h"
#include "relucent/calibration/leftovers.h"
#include "relucent/calibration/shot_file.h"
#include "relucent/pipeline/perfect.h"
#include "relucent/platform/files.h"

namespace relucent::pipeline {
namespace fs = std::filesystem;
namespace {

using calibration::CalibrationFolder;

DiskShare shareOf(const fs::path& path) {
  std::error_code code;
  if (fs::is_regular_file(fs::symlink_status(path, code))) return {1, fs::file_size(path, code)};
  DiskShare share;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(path, code))
    if (!entry.is_symlink(code) && entry.is_regular_file(code)) {
      ++share.files;
      share.bytes += entry.file_size(code);
    }
  return share;
}

void add(DiskShare& sum, const DiskShare& share) {
  sum.files += share.files;
  sum.bytes += share.bytes;
}

DiskShare shareOf(const std::vector<fs::path>& paths) {
  DiskShare sum;
  for (const fs::path& path : paths) add(sum, shareOf(path));
  return sum;
}

void removeAll(const fs::path& path) {
  std::error_code code;
  fs::remove_all(path, code);
  if (code)
    throw Error(
        ErrorKind::disk,
        RELUCENT_ENGLISH_MESSAGE("tidy.cannot-remove", "this cannot be removed ({})").with(code.message()),
        RELUCENT_ENGLISH_MESSAGE("tidy.check-permission",
                                 "check that the folder may be written to, then try again"),
        path.string());
}

std::vector<fs::path> allShots(const CalibrationFolder& folder) {
  std::vector<fs::path> shots;
  std::error_code code;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder.shotFolder(), code))
    if (entry.path().extension() == ".shot" && !entry.path().filename().string().starts_with(".") &&
        entry.is_regular_file(code) && !entry.is_symlink(code))
      shots.push_back(entry.path());
  std::ranges::sort(shots);
  return shots;
}

bool isSame(const rig::RawFrame& a, const rig::RawFrame& b) {
  const std::vector<float>&x = a.signal.data(), &y = b.signal.data();
  return a.bits == b.bits && a.seconds == b.seconds && a.signal.size() == b.signal.size() &&
         x.size() == y.size() && std::memcmp(x.data(), y.data(), x.size() * sizeof(float)) == 0;
}

/// To the last bit.
bool isSame(const rig::Shot& a, const rig::Shot& b) {
  return a.id == b.id && a.fingerprint == b.fingerprint && a.exposuresAsked == b.exposuresAsked &&
         std::ranges::equal(a.frames, b.frames, [](const auto& exposure, const auto& other) {
           return std::ranges::equal(exposure, other,
                                     [](const auto& x, const auto& y) { return isSame(x, y); });
         });
}

/// The compressed form of a photograph's file; none if it is compressed already, damaged, or no smaller.
std::optional<std::string> smallerFormOf(const std::string& stored) {
  if (!calibration::isPlainShotFile(stored)) return std::nullopt;
  const std::optional<rig::Shot> shot = calibration::shotFrom(stored);
  if (!shot) return std::nullopt;
  std::string smaller = calibration::shotFileOf(*shot);
  const std::optional<rig::Shot> again = calibration::shotFrom(smaller);
  require(again && isSame(*shot, *again), "shot {} of {} is another one when it is compressed",
          shot->id.number, shot->id.stage);
  return smaller.size() < stored.size() ? std::optional(std::move(smaller)) : std::nullopt;
}

/// Replaces a photograph by its compressed form, after that was read back from the disk.
void replace(const fs::path& shot, const std::string& smaller) {
  writeFileAtomically(shot, [&](const fs::path& temporary) {
    const platform::FileOutcome written = platform::writeContent(temporary, smaller);
    if (written.code || readFile(temporary) != smaller)
      throw Error(
          ErrorKind::disk,
          RELUCENT_ENGLISH_MESSAGE("tidy.cannot-compress",
                                   "this photograph cannot be written compressed ({})")
              .with(written.code ? written.code.message() : "what was written reads differently"),
          RELUCENT_ENGLISH_MESSAGE("tidy.photograph-is-as-it-was",
                                   "it is as it was: free some space or check the disk, then try again"),
          shot.string());
  });
}

/// One calibration. What it frees is counted the same way whether it does so or only says so.
class Tidying {
 public:
  /// Looks at it before it is opened for writing, which clears away what interrupted writes left.
  Tidying(const fs::path& path, const TidySettings& settings)
      : settings_(settings), folder_(CalibrationFolder::open(path, CalibrationFolder::Access::read)) {
    done_.folder = path;
    leftovers_ = calibration::leftovers(*folder_);
    done_.leftovers = shareOf(leftovers_);
    bytes_ = shareOf(folder_->shotFolder()).bytes;
    if (settings.dryRun) return;
    folder_.reset();
    folder_ = CalibrationFolder::open(path, CalibrationFolder::Access::write);
  }

  /// Of all photographs: what tidying takes its time for.
  std::uint64_t bytes() const { return bytes_; }

  TidiedCalibration run(Progress& progress) {
    progress.checkpoint();
    done_.isComplete = isComplete(*folder_);
    const std::vector<fs::path> replaced = calibration::replacedResults(*folder_);
    done_.results = shareOf(replaced);
    if (!settings_.dryRun) {
      for (const fs::path& path : leftovers_) removeAll(path);
      for (const fs::path& path : replaced) removeAll(path);
    }
    removeOutdated();
    const std::vector<fs::path> kept = removeOthers();
    for (std::size_t i = 0; i < kept.size(); ++i) {
      compress(kept[i]);
      progress.report(static_cast<double>(i + 1) / static_cast<double>(kept.size()));
    }
    return done_;
  }

 private:
  void removeOutdated() {
    for (const PerfectedPicture& picture : allPerfected(folder_->path())) {
      if (!isOutOfDate(picture, *folder_)) continue;
      add(done_.perfected, shareOf(perfectedFolder(folder_->path()) / picture.key));
      if (!settings_.dryRun) removePerfected(picture);
    }
  }

  /// The photographs that stay.
  std::vector<fs::path> removeOthers() {
    const KeptPhotographs wanted = settings_.kept ? *settings_.kept : keptPhotographs(*folder_);
    const std::vector<fs::path> all = allShots(*folder_);
    std::vector<fs::path> removable = removablePhotographs(*folder_, wanted);
    done_.photographs = settings_.dryRun ? shareOf(removable) : removePhotographs(*folder_, wanted);
    std::ranges::sort(removable);
    std::vector<fs::path> kept;
    std::ranges::set_difference(all, removable, std::back_inserter(kept));
    return kept;
  }

  void compress(const fs::path& shot) {
    const std::string stored = readFile(shot);
    std::size_t bytes = stored.size();
    if (const std::optional<std::string> smaller = smallerFormOf(stored)) {
      if (!settings_.dryRun) replace(shot, *smaller);
      add(done_.compressed, {1, bytes - smaller->size()});
      bytes = smaller->size();
    }
    add(done_.kept, {1, bytes});
  }

  TidySettings settings_;
  std::optional<CalibrationFolder> folder_;
  std::vector<fs::path> leftovers_;
  std::uint64_t bytes_ = 0;
  TidiedCalibration done_;
};

}  // namespace

TidyResult tidy(const std::vector<fs::path>& folders, const TidySettings& settings, Progress& progress) {
  std::vector<fs::path> paths, known;  // a folder may have been named twice
  for (const fs::path& folder : folders) {
    std::error_code code;
    const fs::path whole = fs::weakly_canonical(folder, code);
    if (std::ranges::find(known, whole) != known.end()) continue;
    known.push_back(whole);
    paths.push_back(folder);
  }
  std::vector<Tidying> tidyings;
  for (const fs::path& path : paths) tidyings.emplace_back(path, settings);
  std::uint64_t bytes = 0;
  for (const Tidying& tidying : tidyings) bytes += tidying.bytes();

  TidyResult result;
  result.dryRun = settings.dryRun;
  for (std::size_t i = 0; i < tidyings.size(); ++i) {
    Progress part = progress.part(
        bytes == 0 ? 0.0 : static_cast<double>(tidyings[i].bytes()) / static_cast<double>(bytes),
        RELUCENT_ENGLISH_MESSAGE("stage.tidying", "Tidying {}").with(paths[i].filename().string()));
    result.calibrations.push_back(tidyings[i].run(part));
  }
  progress.report(1.0);
  return result;
}

}  // namespace relucent::pipeline
