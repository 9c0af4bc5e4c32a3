// SPDX-License-Identifier: MIT
#include "relucent/pipeline/stills.h"

#include <algorithm>
#include <array>

#include "relucent/base/error.h"
#include "relucent/base/file.h"
#include "relucent/base/lowered.h"
#include "relucent/base/parsed_json.h"
#include "relucent/calibration/json.h"

namespace relucent::pipeline {
namespace fs = std::filesystem;
namespace {

constexpr std::array stillEndings{".png", ".jpg", ".jpeg", ".tif", ".tiff", ".exr", ".bmp", ".webp"};

// What is no file, whatever its name ends with, see gui's ContentAddress.
constexpr std::array otherContent{"chart:", "screen:", "window:", "camera:", "stream:"};

bool isStill(const fs::path& file) {
  const std::string path = file.string();
  if (std::ranges::any_of(otherContent, [&](const char* kind) { return path.starts_with(kind); }))
    return false;
  return std::ranges::count(stillEndings, lowered(file.extension().string())) > 0;
}

std::vector<fs::path> ofPlaylist(const fs::path& file) {
  try {
    std::vector<fs::path> stills;
    const calibration::Json playlist = parsedJson<calibration::Json>(readFile(file));
    for (const calibration::Json& item : playlist.at("items"))
      if (const fs::path path = item.at("path").get<std::string>(); isStill(path))
        stills.push_back((fs::absolute(file).parent_path() / path).lexically_normal());
    return stills;
  } catch (const calibration::Json::exception& cause) {
    throw Error(ErrorKind::format,
                RELUCENT_ENGLISH_MESSAGE("content.not-a-playlist-because", "this is not a playlist ({})")
                    .with(cause.what()),
                RELUCENT_ENGLISH_MESSAGE("content.open-with-its-program",
                                         "open it with the program that wrote it, or make a new playlist"),
                file.string());
  }
}

}  // namespace

std::vector<fs::path> stillsOf(const fs::path& path) {
  std::vector<fs::path> stills;
  if (fs::is_directory(path)) {
    std::error_code unreadable;
    for (const fs::directory_entry& entry : fs::directory_iterator(path, unreadable))
      if (entry.is_regular_file() && isStill(entry.path())) stills.push_back(entry.path());
    std::ranges::sort(stills);
  } else if (lowered(path.extension().string()) == ".playlist") {
    stills = ofPlaylist(path);
  } else {
    return {path};
  }
  if (stills.empty())
    throw Error(ErrorKind::input,
                RELUCENT_ENGLISH_MESSAGE("perfect.no-pictures", "there is no still picture to perfect"),
                RELUCENT_ENGLISH_MESSAGE("perfect.films-are-not",
                                         "films and live pictures are corrected as they are shown"),
                path.string());
  return stills;
}

}  // namespace relucent::pipeline
