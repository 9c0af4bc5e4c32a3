// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

namespace relucent {

/// The whole file. Throws: Error{disk} if it is missing or unreadable.
std::string readFile(const std::filesystem::path& path);

/// Replaces `path` by `content` atomically: temporary name in the same folder, fsync, rename, fsync of the
/// folder. After a crash either the old or the new file is there, never a part of one. Throws: Error{disk};
/// `path` is untouched.
void writeFileAtomically(const std::filesystem::path& path, std::string_view content);

/// The same for a file that only its owner can read: there is no moment at which others could.
void writePrivateFileAtomically(const std::filesystem::path& path, std::string_view content);

/// The same for libraries that write files themselves: `write` gets the temporary name (same folder, same
/// extension). Its exceptions are rethrown after the temporary file has been removed.
void writeFileAtomically(const std::filesystem::path& path,
                         const std::function<void(const std::filesystem::path& temporary)>& write);

/// Returns when the files in a folder, and their names, are on the disk. Throws: Error{disk}.
void syncFilesIn(const std::filesystem::path& folder);

/// Creates a folder and its parents. Throws: Error{disk} with the reason.
void createFolder(const std::filesystem::path& path);

}  // namespace relucent
