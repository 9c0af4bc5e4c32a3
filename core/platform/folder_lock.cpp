// SPDX-License-Identifier: MIT
#include "relucent/platform/folder_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

namespace relucent::platform {

FolderLock::FolderLock(const std::filesystem::path& folder, Kind kind)
    : descriptor_(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
  if (descriptor_ < 0) throw std::system_error(errno, std::generic_category());

  // The folder itself is locked, not a file in it: nothing has to be written, and a file that is replaced by
  // renaming would take its lock away with it.
  int operation = (kind == Kind::write ? LOCK_EX : LOCK_SH) | LOCK_NB;
  int result = 0;
  do result = ::flock(descriptor_, operation);
  while (result != 0 && errno == EINTR);
  if (result == 0 || errno != EWOULDBLOCK) return;

  ::close(std::exchange(descriptor_, -1));
  throw std::system_error(EWOULDBLOCK, std::generic_category());
}

FolderLock::~FolderLock() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

FolderLock::FolderLock(FolderLock&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}

FolderLock& FolderLock::operator=(FolderLock&& other) noexcept {
  std::swap(descriptor_, other.descriptor_);
  return *this;
}

}  // namespace relucent::platform
