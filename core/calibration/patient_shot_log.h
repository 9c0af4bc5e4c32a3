// SPDX-License-Identifier: MIT
#pragma once

#include "relucent/calibration/room_on_disk.h"
#include "relucent/rig/shot.h"

namespace relucent::calibration {

/// A log on a disk that may fill up: there photographing pauses, projectors dark, until there is room. It
/// does so while there is still room for what else is written, and never loses a shot that was taken.
class PatientShotLog : public rig::ShotLog {
 public:
  /// Besides the next shots, so much stays free for manifests and other programs. Bytes.
  static constexpr std::uint64_t spare = std::uint64_t{16} << 20;
  /// Photographing pauses where fewer than this many shots have room.
  static constexpr std::uint64_t shotsAhead = 4;

  /// Keeps references: all outlive it.
  PatientShotLog(rig::ShotLog& log, RoomOnDisk& room, rig::Rig& rig) : log_(log), room_(room), rig_(rig) {}

  std::optional<rig::Shot> find(const rig::ShotId& id, const std::string& fingerprint) override {
    return log_.find(id, fingerprint);
  }
  /// Pauses before, if the disk is full, and after, if the next shots have no room on it.
  /// Throws: as RoomOnDisk, and what the log throws.
  void keep(const rig::Shot& shot) override;
  std::uint64_t bytesOfLast() const override { return log_.bytesOfLast(); }
  void forget(const rig::ShotId& id, const std::string& fingerprint) override {
    log_.forget(id, fingerprint);
  }

 private:
  rig::ShotLog& log_;
  RoomOnDisk& room_;
  rig::Rig& rig_;
};

}  // namespace relucent::calibration
