// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>

namespace relucent::test {

/// A disk of its own, in memory, that only this process and those that it starts see. To be made before any
/// thread is started, and after enterOwnNetwork(), which makes it possible for any user.
class SmallDisk {
 public:
  /// At `folder`, which is created.
  SmallDisk(std::filesystem::path folder, std::uint64_t bytes);
  ~SmallDisk();
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;

  /// False: nobody may mount here, and the folder is an ordinary one.
  bool isMounted() const { return mounted_; }
  const std::filesystem::path& folder() const { return folder_; }
  std::uint64_t freeBytes() const;
  /// Somebody copies films to it until so much is left.
  void fillUpTo(std::uint64_t left);
  /// And removes them.
  void makeRoom();

 private:
  std::filesystem::path ballast() const { return folder_ / "films"; }

  std::filesystem::path folder_;
  bool mounted_ = false;
};

}  // namespace relucent::test
