// SPDX-License-Identifier: MIT
#include "relucent/calibration/room_on_disk.h"

#include <limits>

#include "relucent/base/disk_full.h"

namespace relucent::calibration {
namespace fs = std::filesystem;
namespace {

/// False: the disk is full.
bool hasWritten(const RoomOnDisk::Action& write) {
  try {
    write();
  } catch (const DiskFull&) {
    return false;
  }
  return true;
}

/// Tells the waiter at the end, however that comes.
class Pause {
 public:
  Pause(RoomWaiter& waiter, std::chrono::steady_clock::duration& sum) : waiter_(waiter), sum_(sum) {}
  ~Pause() {
    sum_ += std::chrono::steady_clock::now() - begin_;
    waiter_.over();
  }
  Pause(const Pause&) = delete;
  Pause& operator=(const Pause&) = delete;

 private:
  RoomWaiter& waiter_;
  std::chrono::steady_clock::duration& sum_;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

}  // namespace

std::uint64_t RoomWaiter::freeBytes(const fs::path& folder) const {
  std::error_code code;
  const fs::space_info space = fs::space(folder, code);
  return code ? std::numeric_limits<std::uint64_t>::max() : space.available;
}

bool RoomOnDisk::mayGoOn(std::uint64_t needed) {
  progress_.checkpoint();
  const FullDisk disk{folder_, waiter_->freeBytes(folder_), needed};
  if (disk.free >= needed) return true;
  isTold_ = waiter_->wait(disk) == RoomWaiter::Answer::goOn;
  return isTold_;
}

void RoomOnDisk::waitFor(std::uint64_t least, std::uint64_t enough, const Action& pausing) {
  if (waiter_ == nullptr || isTold_ || waiter_->freeBytes(folder_) >= least) return;
  const Pause pause(*waiter_, paused_);
  if (pausing) pausing();
  while (!mayGoOn(enough)) {
  }
}

void RoomOnDisk::write(std::uint64_t bytes, const Action& write, const Action& pausing) {
  if (hasWritten(write)) return;
  if (waiter_ == nullptr)
    throw Error(ErrorKind::disk, RELUCENT_MESSAGE("calibration.disk-full", "the disk is full"),
                RELUCENT_MESSAGE("calibration.make-room-then-resume",
                                 "every photograph so far is safe: free at least {} MB there, then resume")
                    .with(as::megabytes(bytes + (std::uint64_t{1} << 20))),
                folder_.string());
  const Pause pause(*waiter_, paused_);
  if (pausing) pausing();
  do {
    // Whoever has a quota may find bytes free and the disk full all the same.
    progress_.checkpoint();
    isTold_ = waiter_->wait({folder_, waiter_->freeBytes(folder_), bytes}) == RoomWaiter::Answer::goOn;
  } while ((!isTold_ && waiter_->freeBytes(folder_) < bytes) || !hasWritten(write));
}

}  // namespace relucent::calibration
