// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

namespace relucent {

/// Whether a text is one name of a file or folder, that leads nowhere else: what files of strangers name has
/// to lie beside them.
inline bool isFileName(const std::string& text) {
  const std::filesystem::path path(text);
  return path.has_filename() && path.filename() == path && text != "." && text != ".." &&
         text.find('\0') == std::string::npos;
}

}  // namespace relucent
