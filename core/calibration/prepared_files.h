// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "relucent/platform/folder_lock.h"

namespace relucent::calibration {

/// Files that are written before it is decided whether a calibration will have them, as while a repair is
/// proved: disks take long, and may as well do so meanwhile. They lie in a hidden folder among its results,
/// which is locked: who opens the calibration for writing leaves it alone as long as this lives, and clears
/// it away once the program is dead. Nothing of the calibration itself is changed, nor has it to be open.
class PreparedFiles {
 public:
  /// Throws: Error{disk}.
  explicit PreparedFiles(const std::filesystem::path& calibration);
  /// Removes what was not moved.
  ~PreparedFiles();
  PreparedFiles(const PreparedFiles&) = delete;
  PreparedFiles& operator=(const PreparedFiles&) = delete;

  /// Where they are written.
  const std::filesystem::path& folder() const { return folder_; }
  /// All of them, to another folder of the same calibration. Throws: Error{disk}.
  void moveTo(const std::filesystem::path& folder) const;

 private:
  std::filesystem::path folder_;
  platform::FolderLock lock_;
};

/// Whether this is the folder of PreparedFiles that are alive.
bool isBeingPrepared(const std::filesystem::path& folder);

}  // namespace relucent::calibration
