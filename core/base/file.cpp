// SPDX-License-Identifier: MIT
#include "relucent/base/file.h"

#include <fmt/format.h>

#include <cerrno>
#include <fstream>
#include <sstream>

#include "relucent/base/disk_full.h"
#include "relucent/base/error.h"
#include "relucent/platform/files.h"
#include "relucent/platform/process.h"

namespace relucent {
namespace fs = std::filesystem;
namespace {

Message adviceFor(const std::error_code& code) {
  if (platform::isDiskFull(code))
    return RELUCENT_MESSAGE("disk.free-space-or-choose-another",
                            "free some space there or choose another disk, then try again");
  switch (code.value()) {
    case EACCES:
    case EPERM:
    case EROFS:
      return RELUCENT_MESSAGE("disk.choose-writable-folder",
                              "choose a folder that you may write to, or ask for the permission");
    case ENOENT:
      return RELUCENT_MESSAGE("disk.check-path", "check the path");
    case EIO:
      return RELUCENT_MESSAGE("disk.check-disk-and-cable", "check the disk and its cable");
    default:
      return RELUCENT_MESSAGE("disk.check-path-and-disk", "check the path and the disk");
  }
}

enum class Action { open, read, write, createFolder };

Message failureOf(Action action, const std::string& reason) {
  switch (action) {
    case Action::open:
      return RELUCENT_MESSAGE("disk.cannot-open", "cannot open ({})").with(reason);
    case Action::read:
      return RELUCENT_MESSAGE("disk.cannot-read", "cannot read ({})").with(reason);
    case Action::write:
      return RELUCENT_MESSAGE("disk.cannot-write", "cannot write ({})").with(reason);
    case Action::createFolder:
      return RELUCENT_MESSAGE("disk.cannot-create-folder", "cannot create the folder ({})").with(reason);
  }
  return {};
}

[[noreturn]] void failDisk(Action action, const fs::path& path, const std::error_code& code) {
  if (platform::isDiskFull(code))
    throw DiskFull(ErrorKind::disk, failureOf(action, code.message()), adviceFor(code), path.string());
  throw Error(ErrorKind::disk, failureOf(action, code.message()), adviceFor(code), path.string());
}

[[noreturn]] void failDisk(Action action, const fs::path& path, int code) {
  failDisk(action, path, std::error_code(code, std::generic_category()));
}

void checkSynced(const platform::FileOutcome& outcome, const fs::path& path) {
  if (outcome.code) failDisk(outcome.opened ? Action::write : Action::open, path, outcome.code);
}

}  // namespace

std::string readFile(const fs::path& path) {
  std::error_code code;
  if (fs::is_directory(path, code)) failDisk(Action::read, path, EISDIR);
  std::ifstream stream(path, std::ios::binary);
  if (!stream) failDisk(Action::read, path, errno != 0 ? errno : ENOENT);
  std::ostringstream content;
  content << stream.rdbuf();
  if (stream.bad()) failDisk(Action::read, path, EIO);
  return std::move(content).str();
}

void writeFileAtomically(const fs::path& path, std::string_view content) {
  writeFileAtomically(path, [&](const fs::path& temporary) {
    if (const platform::FileOutcome outcome = platform::writeContent(temporary, content); outcome.code)
      failDisk(Action::write, path, outcome.code);
  });
}

void writePrivateFileAtomically(const fs::path& path, std::string_view content) {
  writeFileAtomically(path, [&](const fs::path& temporary) {
    if (const platform::FileOutcome outcome = platform::writePrivateContent(temporary, content); outcome.code)
      failDisk(Action::write, path, outcome.code);
  });
}

void writeFileAtomically(const fs::path& path, const std::function<void(const fs::path&)>& write) {
  fs::path temporary = path.parent_path() / fmt::format(".{}.part{}{}", path.stem().string(),
                                                        platform::processNumber(), path.extension().string());
  try {
    write(temporary);
    checkSynced(platform::syncFile(temporary), temporary);
    std::error_code code;
    fs::rename(temporary, path, code);
    if (code) failDisk(Action::write, path, code);
    fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
    checkSynced(platform::syncFolder(folder), folder);
  } catch (...) {
    std::error_code ignored;
    fs::remove(temporary, ignored);
    throw;
  }
}

void syncFilesIn(const fs::path& folder) {
  std::error_code code;
  for (fs::directory_iterator entry(folder, code), end; !code && entry != end; entry.increment(code))
    checkSynced(platform::syncFile(entry->path()), entry->path());
  if (code) failDisk(Action::write, folder, code);
  checkSynced(platform::syncFolder(folder), folder);
}

void createFolder(const fs::path& path) {
  std::error_code code;
  fs::create_directories(path, code);
  if (code) failDisk(Action::createFolder, path, code);
  if (!fs::is_directory(path)) failDisk(Action::createFolder, path, ENOTDIR);
}

}  // namespace relucent
