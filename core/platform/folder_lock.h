// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

namespace relucent::platform {

/// A lock on a folder against other programs, let go when it is destroyed and, by the system, when the
/// program dies. Several readers or one writer. File systems without locks (some network shares) grant all.
class FolderLock {
 public:
  enum class Kind { read, write };

  /// Does not wait. Throws: std::system_error with operation_would_block if another program holds a lock that
  /// excludes this one; else with the reason why the folder cannot be opened.
  FolderLock(const std::filesystem::path& folder, Kind kind);
  ~FolderLock();
  FolderLock(FolderLock&& other) noexcept;
  FolderLock& operator=(FolderLock&& other) noexcept;

 private:
  int descriptor_ = -1;
};

}  // namespace relucent::platform
