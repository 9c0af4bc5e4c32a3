// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <type_traits>

namespace relucent::platform {
class UnnamedFile;
}

namespace relucent {

/// Room on a disk for what a computation does not keep in memory: a file in $TMPDIR, or /var/tmp, that
/// nobody else sees and that is gone afterwards. Parts may be written and read on several threads at once;
/// what was never written reads as zeros.
class ScratchFile {
 public:
  /// Throws: Error{disk} if there is no such file to be had.
  ScratchFile();
  ~ScratchFile();
  ScratchFile(ScratchFile&&) noexcept;
  ScratchFile& operator=(ScratchFile&&) noexcept;

  /// `at`: in bytes.  Throws: Error{disk}, as when the disk is full.
  template <typename Value>
  void write(std::uint64_t at, std::span<const Value> values) {
    static_assert(std::is_trivially_copyable_v<Value>);
    writeBytes(at, std::as_bytes(values));
  }
  template <typename Value>
  void read(std::uint64_t at, std::span<Value> values) const {
    static_assert(std::is_trivially_copyable_v<Value>);
    readBytes(at, std::as_writable_bytes(values));
  }

 private:
  void writeBytes(std::uint64_t at, std::span<const std::byte> bytes);
  void readBytes(std::uint64_t at, std::span<std::byte> bytes) const;

  std::unique_ptr<platform::UnnamedFile> file_;
};

}  // namespace relucent
