// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "relucent/base/progress.h"
#include "relucent/base/raster.h"
#include "relucent/importing/import.h"
#include "relucent/platform/memory_limits.h"
#include "relucent/reduction/pixel_use.h"

namespace relucent::pipeline {

struct ImportPicturesSettings {
  std::filesystem::path patterns;  // folder of pictures: what was projected, in the projector's own pixels
  /// Folder of pictures: linear signals, one for each pattern; JPEG is decoded by the curve of sRGB. Raw
  /// files give the sensor's own values at half its size; of a photograph that is there twice the raw file
  /// counts.
  std::filesystem::path photographs;
  reduction::PixelUse pixels;  // of the photographs, which are reduced as they are read
  importing::ImportSettings import;
};
std::vector<Message> problems(const ImportPicturesSettings& settings);

struct ImportResult {
  int patterns = 0;
  int fitted = 0;
  int heldOut = 0;
  importing::HeldOutError error;  // on held-out patterns, normalised root mean square
  Size projector;
  Size camera;
  std::uint64_t leaves = 0;
  double flaggedShare = 0.0;
  double seconds = 0.0;
  std::uint64_t peakMemoryBytes = 0;
  std::vector<Message> findings;
};

/// A new calibration out of patterns and photographs taken elsewhere, paired in the order of their names, or
/// in the order in which raw files were taken (photograph_sequence.h); files that are no pictures are passed
/// over. Nothing is written before everything is computed. Throws:
/// Error{input} if the folders hold different numbers of pictures or pictures of different sizes, if `folder`
/// holds anything already, or as importTransport(); Error{memory} before the photographs are read;
/// Error{disk, format} for unreadable files.
ImportResult importPictures(const std::filesystem::path& folder, const ImportPicturesSettings& settings,
                            Progress& progress);
/// The same with so much memory; without, platform::memoryLeft().
ImportResult importPictures(const std::filesystem::path& folder, const ImportPicturesSettings& settings,
                            const platform::MemoryUse& memory, Progress& progress);

}  // namespace relucent::pipeline
