// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "relucent/base/progress.h"
#include "relucent/pipeline/written_files.h"

namespace relucent::pipeline {

struct ExportSettings {
  std::filesystem::path transport;  // T as SciPy BSR, 3x3 blocks, expanded to pixels; empty: not wanted
  std::filesystem::path leaves;   // T as it is kept: a column for every node of the projectors' mean pyramids
  std::filesystem::path inverse;  // the inverse operator, SciPy BSR, 3x3 blocks; empty: not wanted
  std::filesystem::path maps;     // folder for black, flood, reachability, flags as EXR; empty: not wanted
  std::filesystem::path mpcdi;    // warp and blend for media servers, see mapping/; empty: not wanted
  std::filesystem::path playerMaps;  // the same as plain pictures, and colour tables; empty: not wanted
  Size canvas{1920, 1080};           // pixels of the content that media servers play
  std::uint64_t mostBytes = std::uint64_t{2} << 30;  // of `transport`, see expandedToPixels()
  std::string set{};  // of which media servers' maps are, see sets.h; empty: the one in use
};
std::vector<Message> problems(const ExportSettings& settings);

/// Writes the measured data for other programs.
WrittenFiles exportCalibration(const std::filesystem::path& folder, const ExportSettings& settings,
                               Progress& progress);

}  // namespace relucent::pipeline
