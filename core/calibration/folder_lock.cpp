// SPDX-License-Identifier: MIT
#include "calibration/folder_lock.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "base/error.h"

namespace relucent {

FolderLock::FolderLock(const std::filesystem::path& folder, Kind kind)
    : descriptor_(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
  if (descriptor_ < 0)
    throw Error(ErrorKind::disk, fmt::format("cannot open the folder ({})", std::strerror(errno)),
                "check the path and that you may read it", folder.string());

  // The folder itself is locked, not a file in it: nothing has to be written, and the manifest, which is
  // replaced by renaming, would take its lock away with the old file.
  int operation = (kind == Kind::write ? LOCK_EX : LOCK_SH) | LOCK_NB;
  int result = 0;
  do result = ::flock(descriptor_, operation);
  while (result != 0 && errno == EINTR);
  if (result == 0 || errno != EWOULDBLOCK) return;

  ::close(std::exchange(descriptor_, -1));
  throw Error(ErrorKind::input, "another program is working on this calibration",
              "wait until it has finished, or close it, then try again", folder.string());
}

FolderLock::~FolderLock() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

FolderLock::FolderLock(FolderLock&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}

FolderLock& FolderLock::operator=(FolderLock&& other) noexcept {
  std::swap(descriptor_, other.descriptor_);
  return *this;
}

}  // namespace relucent
