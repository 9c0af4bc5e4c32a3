// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "relucent/rig/shot.h"

namespace relucent::calibration {

/// Whether an interrupted write left this file in a journal: no program reads it.
bool isShotLeftover(const std::filesystem::path& file);

/// Shots on disk, one file each: what makes a measurement resumable.
///
/// The form of a file is shot_file.h's.
/// Names: <stage>-<number>-<fingerprint>.shot, so that shots taken with other settings stay.
class ShotJournal : public rig::ShotLog {
 public:
  /// Creates `folder`, and clears away what an interrupted write left there. Throws: Error{disk}.
  explicit ShotJournal(std::filesystem::path folder);

  /// The same bits that keep() was given. A file that is foreign, damaged or cut short counts as none.
  std::optional<rig::Shot> find(const rig::ShotId& id, const std::string& fingerprint) override;
  /// Throws: Error{disk}; then everything kept before is as it was.
  void keep(const rig::Shot& shot) override;
  std::uint64_t bytesOfLast() const override { return bytesOfLast_; }
  /// Throws: Error{disk}.
  void forget(const rig::ShotId& id, const std::string& fingerprint) override;

  /// When a shot was kept; none: it is not there.
  std::optional<std::filesystem::file_time_type> keptAt(const rig::ShotId& id,
                                                        const std::string& fingerprint) const;

  const std::filesystem::path& folder() const { return folder_; }

 private:
  std::filesystem::path pathOf(const rig::ShotId& id, const std::string& fingerprint) const;

  std::filesystem::path folder_;
  std::uint64_t bytesOfLast_ = 0;
};

}  // namespace relucent::calibration
