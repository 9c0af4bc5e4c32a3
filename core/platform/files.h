// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string_view>
#include <system_error>

namespace relucent::platform {

/// What came of an operation on a file. `code` is that of the system; none: all went well.
struct FileOutcome {
  std::error_code code;
  bool opened = true;  // false: it failed before anything was read or written
};

/// Makes the file new with this content. What it held before is lost.
FileOutcome writeContent(const std::filesystem::path& path, std::string_view content);

/// The same so that only the file's owner can read it.
FileOutcome writePrivateContent(const std::filesystem::path& path, std::string_view content);

/// Adds a text at the end of a file, which is made if it is missing. Whoever appends at the same time does so
/// before or after it, never within.
FileOutcome appendContent(const std::filesystem::path& path, std::string_view content);

/// Returns when what was written to the file is on the disk.
FileOutcome syncFile(const std::filesystem::path& path);
/// The same of the names in a folder. File systems that cannot do this count as having done it.
FileOutcome syncFolder(const std::filesystem::path& path);

/// The disk, or the user's share of it, has no room left.
bool isDiskFull(const std::error_code& code);

}  // namespace relucent::platform
