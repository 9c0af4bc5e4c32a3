// SPDX-License-Identifier: MIT
#include "relucent/cli/terminal_room.h"

#include <fmt/format.h>

#include <thread>
#include <utility>

namespace relucent::cli {

std::string fullDiskSentence(const calibration::FullDisk& disk, std::uint64_t rest) {
  const std::string all =
      rest > disk.needed ? fmt::format(" ({} for all that is left)", bytesText(rest)) : std::string();
  return fmt::format(
      "Paused: the disk of {} is full, {} are free. Every photograph is safe. Free at least {} there{}: it "
      "goes on by itself. Ctrl-C stops, to be resumed later.",
      disk.folder.string(), bytesText(disk.free), bytesText(disk.needed), all);
}

TerminalRoom::TerminalRoom(TerminalProgress& terminal, Sleep sleep)
    : terminal_(terminal), sleep_(std::move(sleep)) {
  if (!sleep_) sleep_ = [](std::chrono::milliseconds time) { std::this_thread::sleep_for(time); };
}

calibration::RoomWaiter::Answer TerminalRoom::wait(const calibration::FullDisk& disk) {
  constexpr std::chrono::milliseconds betweenLooks{200};
  if (!std::exchange(isSaid_, true)) {
    terminal_.pause();
    terminal_.say(fullDiskSentence(disk, terminal_.workLeft().diskBytes));
  }
  sleep_(betweenLooks);
  return Answer::look;
}

void TerminalRoom::over() {
  if (std::exchange(isSaid_, false)) terminal_.resume();
}

}  // namespace relucent::cli
