// SPDX-License-Identifier: MIT
#include "relucent/platform/files.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>

#include "relucent/platform/descriptor.h"

namespace relucent::platform {
namespace fs = std::filesystem;
namespace {

constexpr mode_t ownersAlone = 0600, asUsual = 0666;

FileOutcome write(const fs::path& path, int flags, std::string_view content, mode_t mode = asUsual) {
  const Descriptor file(::open(path.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC | flags, mode));
  if (!file.ok()) return {lastError(), false};
  while (!content.empty()) {
    const ssize_t written = ::write(file.get(), content.data(), content.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return {lastError()};
    content.remove_prefix(static_cast<std::size_t>(written));
  }
  return {};
}

FileOutcome sync(const fs::path& path, int flags) {
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | flags));
  if (!file.ok()) return {lastError(), false};
  // Some file systems cannot sync a folder.
  if (::fsync(file.get()) != 0 && errno != EINVAL) return {lastError()};
  return {};
}

}  // namespace

FileOutcome writeContent(const fs::path& path, std::string_view content) {
  return write(path, O_TRUNC, content);
}

FileOutcome writePrivateContent(const fs::path& path, std::string_view content) {
  // A file that is there keeps its permissions.
  std::error_code ignored;
  fs::remove(path, ignored);
  return write(path, O_TRUNC | O_EXCL, content, ownersAlone);
}

FileOutcome appendContent(const fs::path& path, std::string_view content) {
  return write(path, O_APPEND, content);
}

FileOutcome syncFile(const fs::path& path) {
  return sync(path, 0);
}

FileOutcome syncFolder(const fs::path& path) {
  return sync(path, O_DIRECTORY);
}

bool isDiskFull(const std::error_code& code) {
  return code == std::errc::no_space_on_device || code == std::error_code(EDQUOT, std::generic_category());
}

}  // namespace relucent::platform
