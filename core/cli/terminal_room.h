// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <functional>

#include "relucent/calibration/room_on_disk.h"
#include "relucent/cli/terminal_progress.h"

namespace relucent::cli {

/// Says on the terminal that the disk is full, once a pause, and looks again a few times a second.
class TerminalRoom : public calibration::RoomWaiter {
 public:
  using Sleep = std::function<void(std::chrono::milliseconds)>;

  /// `sleep` none: the system's.
  explicit TerminalRoom(TerminalProgress& terminal, Sleep sleep = {});

  Answer wait(const calibration::FullDisk& disk) override;
  void over() override;

 private:
  TerminalProgress& terminal_;
  Sleep sleep_;
  bool isSaid_ = false;
};

/// "Paused: the disk of venue is full, 12 MB are free. ..." `rest`: bytes of all that is left; 0: not known.
std::string fullDiskSentence(const calibration::FullDisk& disk, std::uint64_t rest);

}  // namespace relucent::cli
