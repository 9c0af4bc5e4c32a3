// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

namespace relucent::devices {

/// A folder of its own among the system's temporary files, removed with all it holds at the end.
class TemporaryFolder {
 public:
  /// Throws: Error{disk}.
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace relucent::devices
