// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "relucent/inverse/windows.h"

namespace relucent::inverse {

/// Windows on the disk and back, the same bits, as a NumPy archive (transport/npz.h):
///   format b'relucent-windows', key, cameras and projectors (devices, 2), tile,
///   unmix (camera pixels, 3, 3) float32, tile_start (tiles + 1), row (n), weight (n, 3, tile^2) int16,
///   scale (tiles, 3) float32.
/// `key` says, in ASCII, what they were made of. Atomically. Throws: Error{disk}.
void saveWindows(const std::filesystem::path& path, const WindowInverse& windows, const std::string& key);

/// None if the file's are made of something else than `key`.
/// Throws: Error{disk}; Error{format} if anything is missing, damaged or inconsistent; Error{memory}.
std::optional<WindowInverse> loadWindows(const std::filesystem::path& path, const std::string& key);

}  // namespace relucent::inverse
