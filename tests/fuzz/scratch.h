// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string_view>

namespace relucent::fuzz {

/// A folder of this program's own, in memory where there is such a place; it is gone with the program.
const std::filesystem::path& scratch();
/// A file there with this content, without waiting for a disk.
std::filesystem::path scratchFile(const std::filesystem::path& name, std::string_view content);

}  // namespace relucent::fuzz
