// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <vector>

namespace relucent::pipeline {

/// The still pictures that a path names: itself; of a folder those in it, in the order of their names; of a
/// playlist its own, in their order. Films and live pictures are left out. Throws: Error{disk, format} for a
/// playlist that cannot be read; Error{input} if there are none.
std::vector<std::filesystem::path> stillsOf(const std::filesystem::path& path);

}  // namespace relucent::pipeline
