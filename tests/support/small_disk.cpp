// SPDX-License-Identifier: MIT
#include "support/small_disk.h"

#include <fcntl.h>
#include <sched.h>
#include <sys/mount.h>
#include <unistd.h>

#include <string>
#include <utility>

#include "relucent/base/require.h"

namespace relucent::test {
namespace fs = std::filesystem;

SmallDisk::SmallDisk(fs::path folder, std::uint64_t bytes) : folder_(std::move(folder)) {
  fs::create_directories(folder_);
  const std::string options = "size=" + std::to_string(bytes);
  mounted_ = ::unshare(CLONE_NEWNS) == 0 &&
             ::mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) == 0 &&
             ::mount("none", folder_.c_str(), "tmpfs", MS_NOSUID | MS_NODEV, options.c_str()) == 0;
}

SmallDisk::~SmallDisk() {
  if (mounted_) ::umount2(folder_.c_str(), MNT_DETACH);
}

std::uint64_t SmallDisk::freeBytes() const {
  return fs::space(folder_).available;
}

void SmallDisk::fillUpTo(std::uint64_t left) {
  const int file = ::open(ballast().c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0600);
  require(file >= 0, "the disk cannot be filled");
  const std::uint64_t free = freeBytes();
  if (free > left) ::posix_fallocate(file, 0, static_cast<off_t>(free - left));
  ::close(file);
}

void SmallDisk::makeRoom() {
  fs::remove(ballast());
}

}  // namespace relucent::test
