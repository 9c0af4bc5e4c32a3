// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "relucent/base/progress.h"
#include "relucent/pipeline/written_files.h"

namespace relucent::pipeline {

struct RelightSettings {
  std::filesystem::path image;  // relight: linear projector pattern or sRGB file; dual: light from the camera
  std::filesystem::path out;    // EXR (linear) or PNG
};
std::vector<Message> problems(const RelightSettings& settings);

/// What the camera sees under a pattern, e included: T p + e. The image is scaled to the projector's size.
WrittenFiles relight(const std::filesystem::path& folder, const RelightSettings& settings,
                     Progress& progress);

/// Dual photography: the venue as the projector would see it, lit from the camera: T^T c. No image: all
/// white.
WrittenFiles dual(const std::filesystem::path& folder, const RelightSettings& settings, Progress& progress);

}  // namespace relucent::pipeline
