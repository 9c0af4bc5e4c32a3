// SPDX-License-Identifier: MIT
#include "base/file.h"

#include <fmt/format.h>

#include <cerrno>
#include <fstream>
#include <sstream>

#include "base/error.h"
#include "platform/files.h"
#include "platform/process.h"

namespace relucent {
namespace fs = std::filesystem;
namespace {

std::string adviceFor(const std::error_code& code) {
  if (isDiskFull(code)) return "free some space there or choose another disk, then try again";
  switch (code.value()) {
    case EACCES:
    case EPERM:
    case EROFS:
      return "choose a folder that you may write to, or ask for the permission";
    case ENOENT:
      return "check the path";
    case EIO:
      return "check the disk and its cable";
    default:
      return "check the path and the disk";
  }
}

[[noreturn]] void failDisk(const std::string& action, const fs::path& path, const std::error_code& code) {
  throw Error(ErrorKind::disk, fmt::format("cannot {} ({})", action, code.message()), adviceFor(code),
              path.string());
}

[[noreturn]] void failDisk(const std::string& action, const fs::path& path, int code) {
  failDisk(action, path, std::error_code(code, std::generic_category()));
}

void checkSynced(const FileOutcome& outcome, const fs::path& path) {
  if (outcome.code) failDisk(outcome.opened ? "write" : "open", path, outcome.code);
}

}  // namespace

std::string readFile(const fs::path& path) {
  std::error_code code;
  if (fs::is_directory(path, code)) failDisk("read", path, EISDIR);
  std::ifstream stream(path, std::ios::binary);
  if (!stream) failDisk("read", path, errno != 0 ? errno : ENOENT);
  std::ostringstream content;
  content << stream.rdbuf();
  if (stream.bad()) failDisk("read", path, EIO);
  return std::move(content).str();
}

void writeFileAtomically(const fs::path& path, std::string_view content) {
  writeFileAtomically(path, [&](const fs::path& temporary) {
    if (const FileOutcome outcome = writeContent(temporary, content); outcome.code)
      failDisk("write", path, outcome.code);
  });
}

void writeFileAtomically(const fs::path& path, const std::function<void(const fs::path&)>& write) {
  fs::path temporary = path.parent_path() / fmt::format(".{}.part{}{}", path.stem().string(), processNumber(),
                                                        path.extension().string());
  try {
    write(temporary);
    checkSynced(syncFile(temporary), temporary);
    std::error_code code;
    fs::rename(temporary, path, code);
    if (code) failDisk("write", path, code);
    fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
    checkSynced(syncFolder(folder), folder);
  } catch (...) {
    std::error_code ignored;
    fs::remove(temporary, ignored);
    throw;
  }
}

void createFolder(const fs::path& path) {
  std::error_code code;
  fs::create_directories(path, code);
  if (code) failDisk("create the folder", path, code);
  if (!fs::is_directory(path)) failDisk("create the folder", path, ENOTDIR);
}

}  // namespace relucent
