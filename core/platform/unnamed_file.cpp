// SPDX-License-Identifier: MIT
#include "relucent/platform/unnamed_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <string>

#include "relucent/platform/descriptor.h"

namespace relucent::platform {
namespace {

/// For file systems that know only files with names.
int openAndUnlink(const std::filesystem::path& folder) {
  std::string name = (folder / "relucent-XXXXXX").string();
  const int descriptor = ::mkostemp(name.data(), O_CLOEXEC);
  if (descriptor >= 0) ::unlink(name.c_str());
  return descriptor;
}

}  // namespace

std::filesystem::path scratchFolder() {
  const char* wanted = std::getenv("TMPDIR");  // NOLINT(concurrency-mt-unsafe): nothing here sets it
  return wanted && *wanted ? wanted : "/var/tmp";
}

UnnamedFile::UnnamedFile(const std::filesystem::path& folder)
    : descriptor_(::open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0600)) {
  if (descriptor_ < 0 && (errno == EOPNOTSUPP || errno == EISDIR)) descriptor_ = openAndUnlink(folder);
  if (descriptor_ < 0) error_ = lastError();
}

UnnamedFile::~UnnamedFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

std::error_code UnnamedFile::reserve(std::uint64_t bytes) const {
  int failed = EINTR;
  while (failed == EINTR) failed = ::posix_fallocate(descriptor_, 0, static_cast<off_t>(bytes));
  return {failed, std::generic_category()};
}

std::error_code UnnamedFile::write(std::uint64_t at, std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::pwrite(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(at));
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return lastError();
    at += static_cast<std::uint64_t>(written);
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
  return {};
}

std::error_code UnnamedFile::read(std::uint64_t at, std::span<std::byte> bytes) const {
  while (!bytes.empty()) {
    const ssize_t got = ::pread(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(at));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return lastError();
    if (got == 0) {
      std::ranges::fill(bytes, std::byte{0});
      return {};
    }
    at += static_cast<std::uint64_t>(got);
    bytes = bytes.subspan(static_cast<std::size_t>(got));
  }
  return {};
}

}  // namespace relucent::platform
