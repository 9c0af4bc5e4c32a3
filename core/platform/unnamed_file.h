// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <system_error>

namespace relucent::platform {

/// Where large files for a short time belong: $TMPDIR, or /var/tmp, as /tmp may lie in memory.
std::filesystem::path scratchFolder();

/// A file without a name: gone with this object, and when the program dies. Parts may be written and read on
/// several threads at once; what was never written reads as zeros.
class UnnamedFile {
 public:
  explicit UnnamedFile(const std::filesystem::path& folder);
  ~UnnamedFile();
  UnnamedFile(const UnnamedFile&) = delete;
  UnnamedFile& operator=(const UnnamedFile&) = delete;

  /// Why there is no such file; none: there is.
  const std::error_code& error() const { return error_; }

  /// Room on the disk for so many bytes from the beginning, which are zeros.
  std::error_code reserve(std::uint64_t bytes) const;
  std::error_code write(std::uint64_t at, std::span<const std::byte> bytes);
  std::error_code read(std::uint64_t at, std::span<std::byte> bytes) const;

  /// For mapping it; the file's own.
  int descriptor() const { return descriptor_; }

 private:
  int descriptor_ = -1;
  std::error_code error_;
};

}  // namespace relucent::platform
