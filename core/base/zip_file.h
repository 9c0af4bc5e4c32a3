// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <map>
#include <string>

namespace relucent {

/// Names within an archive, with '/' between folders, and contents.
using ZipEntries = std::map<std::string, std::string>;

/// Writes a zip archive atomically; the same entries give the same bytes: all are of the first of January
/// 1980. Throws: Error{disk}.
void writeZip(const std::filesystem::path& path, const ZipEntries& entries);

}  // namespace relucent
