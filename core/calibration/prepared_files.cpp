// SPDX-License-Identifier: MIT
#include "relucent/calibration/prepared_files.h"

#include <fmt/format.h>

#include <string>
#include <system_error>
#include <vector>

#include "relucent/base/error.h"
#include "relucent/base/file.h"
#include "relucent/platform/process.h"

namespace relucent::calibration {
namespace fs = std::filesystem;
namespace {

/// Of the folders that this program makes.
std::string ownPrefix() {
  return fmt::format(".prepared-{}-", platform::processNumber());
}

[[noreturn]] void fail(const fs::path& path, const std::error_code& code) {
  throw Error(ErrorKind::disk,
              RELUCENT_MESSAGE("disk.cannot-write", "cannot write ({})").with(code.message()),
              RELUCENT_MESSAGE("disk.free-space-or-check-disk",
                               "free some space there or check the disk, then try again"),
              path.string());
}

/// A new folder that is taken for what a killed program left until it is locked.
fs::path newFolder(const fs::path& calibration) {
  const fs::path results = calibration / "results";
  createFolder(results);
  for (int number = 1;; ++number) {
    fs::path folder = results / fmt::format("{}{}.part", ownPrefix(), number);
    std::error_code code;
    if (fs::create_directory(folder, code)) return folder;
    if (code) fail(folder, code);
  }
}

platform::FolderLock lockOf(const fs::path& folder) {
  try {
    return {folder, platform::FolderLock::Kind::write};
  } catch (const std::system_error& failure) {
    fail(folder, failure.code());
  }
}

}  // namespace

PreparedFiles::PreparedFiles(const fs::path& calibration)
    : folder_(newFolder(calibration)), lock_(lockOf(folder_)) {}

PreparedFiles::~PreparedFiles() {
  std::error_code ignored;  // it is a leftover then
  fs::remove_all(folder_, ignored);
}

void PreparedFiles::moveTo(const fs::path& folder) const {
  std::error_code code;
  std::vector<fs::path> files;
  for (fs::directory_iterator entry(folder_, code), end; !code && entry != end; entry.increment(code))
    files.push_back(entry->path());
  for (const fs::path& file : files)
    if (!code) fs::rename(file, folder / file.filename(), code);
  if (code) fail(folder, code);
}

bool isBeingPrepared(const fs::path& folder) {
  const std::string name = folder.filename().string();
  if (!name.starts_with(".prepared-")) return false;
  // Locks of network file systems do not hold against the program that has them.
  if (name.starts_with(ownPrefix())) return true;
  try {
    const platform::FolderLock lock(folder, platform::FolderLock::Kind::write);
    return false;
  } catch (const std::system_error& failure) {
    return failure.code() == std::errc::operation_would_block;
  }
}

}  // namespace relucent::calibration
