// SPDX-License-Identifier: MIT
#include "base/file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>

#include "base/descriptor.h"
#include "base/error.h"

namespace relucent {
namespace fs = std::filesystem;
namespace {

std::string adviceFor(int code) {
  switch (code) {
    case ENOSPC:
    case EDQUOT:
      return "free some space there or choose another disk, then try again";
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

[[noreturn]] void failDisk(const std::string& action, const fs::path& path, int code) {
  throw Error(ErrorKind::disk, fmt::format("cannot {} ({})", action, std::strerror(code)), adviceFor(code),
              path.string());
}

int openFile(const fs::path& path, int flags) {
  return ::open(path.c_str(), flags | O_CLOEXEC, 0666);
}

void syncToDisk(const fs::path& path, int flags) {
  Descriptor file(openFile(path, flags));
  if (!file.ok()) failDisk("open", path, errno);
  // Some file systems cannot sync a folder; the rename is still atomic there.
  if (::fsync(file.get()) != 0 && errno != EINVAL) failDisk("write", path, errno);
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
    Descriptor file(openFile(temporary, O_WRONLY | O_CREAT | O_TRUNC));
    if (!file.ok()) failDisk("write", path, errno);
    const char* data = content.data();
    std::size_t left = content.size();
    while (left > 0) {
      ssize_t written = ::write(file.get(), data, left);
      if (written < 0 && errno == EINTR) continue;
      if (written < 0) failDisk("write", path, errno);
      data += written;
      left -= static_cast<std::size_t>(written);
    }
  });
}

void writeFileAtomically(const fs::path& path, const std::function<void(const fs::path&)>& write) {
  fs::path temporary = path.parent_path() / fmt::format(".{}.part{}{}", path.stem().string(), ::getpid(),
                                                        path.extension().string());
  try {
    write(temporary);
    syncToDisk(temporary, O_RDONLY);
    if (::rename(temporary.c_str(), path.c_str()) != 0) failDisk("write", path, errno);
    fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
    syncToDisk(folder, O_RDONLY | O_DIRECTORY);
  } catch (...) {
    std::error_code ignored;
    fs::remove(temporary, ignored);
    throw;
  }
}

void createFolder(const fs::path& path) {
  std::error_code code;
  fs::create_directories(path, code);
  if (code) failDisk("create the folder", path, code.value());
  if (!fs::is_directory(path)) failDisk("create the folder", path, ENOTDIR);
}

}  // namespace relucent
