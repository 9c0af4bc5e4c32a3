// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "relucent/base/progress.h"
#include "relucent/compensation/direct_light.h"

namespace relucent::pipeline {

struct SeparateSettings {
  std::filesystem::path image;  // the pattern whose light is separated; empty: all white
  std::filesystem::path out;    // folder; created; files of the same names are replaced
  compensation::DirectLightSettings direct;
};
std::vector<Message> problems(const SeparateSettings& settings);

struct SeparateResult {
  double directShare = 0.0;  // of all light in the picture
  std::vector<std::filesystem::path> files;
};

/// Direct and indirect light at the scale of the projector's pixels, out of T: D p and (T - D) p, e in
/// neither, D as directPart() says. Writes direct and indirect as .exr (camera signal per second) and .png
/// (to look at, under one white) into `out`.
SeparateResult separate(const std::filesystem::path& folder, const SeparateSettings& settings,
                        Progress& progress);

}  // namespace relucent::pipeline
