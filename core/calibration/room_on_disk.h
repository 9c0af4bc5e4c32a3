// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <utility>

#include "relucent/base/progress.h"

namespace relucent::calibration {

/// A disk that has no room for what a measurement writes next. Bytes.
struct FullDisk {
  std::filesystem::path folder;
  std::uint64_t free = 0;
  std::uint64_t needed = 0;  // free: the measurement then goes on by itself
};

/// Who is told that a measurement has paused because the disk is full, and waits, on the measuring thread.
class RoomWaiter {
 public:
  virtual ~RoomWaiter() = default;
  /// That this user may write there. As the system says; the most there is where it does not.
  virtual std::uint64_t freeBytes(const std::filesystem::path& folder) const;
  enum class Answer {
    look,  // whether there is room by now
    goOn   // with what is free
  };
  /// Called again and again until there is room. Returns after a second or so, sooner if the work is to end.
  virtual Answer wait(const FullDisk& disk) = 0;
  /// The measurement goes on, or ends.
  virtual void over() {}
  /// For how long somebody has paused the devices until now, in all: no part of a measurement's work.
  virtual std::chrono::steady_clock::duration otherPauses() const { return {}; }
};

/// Room for what a measurement writes. Where there is too little, the measurement pauses until there is
/// enough, and nothing is lost meanwhile. With nobody to wait, a full disk is a failure.
class RoomOnDisk {
 public:
  using Action = std::function<void()>;
  using Duration = std::chrono::steady_clock::duration;

  /// Keeps references: `waiter` and `progress` outlive it. `waiter` null: nobody waits.
  RoomOnDisk(std::filesystem::path folder, RoomWaiter* waiter, const Progress& progress)
      : folder_(std::move(folder)),
        waiter_(waiter),
        progress_(progress),
        pausedBefore_(waiter != nullptr ? waiter->otherPauses() : Duration{}) {}

  /// Returns at once if `least` bytes are free, or if nobody waits. Else pauses until `enough` are: more,
  /// where it is to go on for a while before it pauses again. `pausing` is called before. Throws: Cancelled.
  void waitFor(std::uint64_t least, std::uint64_t enough, const Action& pausing = {});
  /// Calls `write` and, as long as it throws DiskFull, waits and calls it again. `bytes`: what it is about to
  /// write.
  /// Throws: Error{disk} if the disk is full and nobody waits; Cancelled; what else `write` throws.
  void write(std::uint64_t bytes, const Action& write, const Action& pausing = {});

  /// How long it has paused in all.
  Duration paused() const { return paused_; }
  /// That and all other pauses that the waiter knows of, since this was made.
  Duration allPauses() const {
    return paused_ + (waiter_ != nullptr ? waiter_->otherPauses() - pausedBefore_ : Duration{});
  }

 private:
  /// Whether so much is free; else waits a moment, and whether somebody said so meanwhile.
  bool mayGoOn(std::uint64_t needed);

  std::filesystem::path folder_;
  RoomWaiter* waiter_;
  const Progress& progress_;
  Duration pausedBefore_;  // by the waiter's other pauses
  bool isTold_ = false;    // to go on with what is free: until the disk is full
  Duration paused_{};
};

}  // namespace relucent::calibration
