// SPDX-License-Identifier: MIT
#include "relucent/calibration/room_on_disk.h"

#include <limits>
#include <utility>

#include "relucent/base/disk_full.h"

namespace relucent::calibration {
namespace fs = std::filesystem;
namespace {

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

void RoomOnDisk::pause(std::uint64_t needed, const Action& pausing,
                       const std::function<bool(std::uint64_t)>& isEnough) {
  const Pause pause(*waiter_, paused_);
  if (pausing) pausing();
  while (true) {
    progress_.checkpoint();
    const std::uint64_t free = waiter_->freeBytes(folder_);
    if (isEnough(free)) return;
    if (waiter_->wait({folder_, free, needed}) == RoomWaiter::Answer::goOn) {
      isTold_ = true;
      return;
    }
  }
}

void RoomOnDisk::waitFor(std::uint64_t least, std::uint64_t enough, const Action& pausing) {
  if (waiter_ == nullptr || isTold_ || waiter_->freeBytes(folder_) >= least) return;
  pause(enough, pausing, [enough](std::uint64_t free) { return free >= enough; });
}

void RoomOnDisk::write(std::uint64_t bytes, const Action& write, const Action& pausing) {
  while (true) {
    try {
      return write();
    } catch (const DiskFull&) {
      if (waiter_ == nullptr)
        throw Error(
            ErrorKind::disk, RELUCENT_MESSAGE("calibration.disk-full", "the disk is full"),
            RELUCENT_MESSAGE("calibration.make-room-then-resume",
                             "every photograph so far is safe: free at least {} MB there, then resume")
                .with(as::megabytes(bytes + (std::uint64_t{1} << 20))),
            folder_.string());
    }
    isTold_ = false;
    // The free space may be a lie where the user has a quota: whoever has waited once tries.
    bool waited = false;
    pause(bytes, pausing, [&](std::uint64_t free) { return std::exchange(waited, true) && free >= bytes; });
  }
}

}  // namespace relucent::calibration
