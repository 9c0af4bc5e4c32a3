// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cctype>
#include <set>

#include "relucent/base/file.h"
#include "relucent/devices/raw/raw_photograph.h"

namespace relucent::devices {

bool isRawName(const std::filesystem::path& path) {
  static const std::set<std::string> endings{
      ".3fr", ".arw", ".cr2", ".cr3", ".crw", ".dng", ".erf", ".fff", ".iiq", ".k25", ".kdc", ".mef", ".mos",
      ".mrw", ".nef", ".nrw", ".orf", ".pef", ".raf", ".raw", ".rw2", ".rwl", ".sr2", ".srf", ".srw", ".x3f"};
  std::string ending = path.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return endings.contains(ending);
}

RawPhotograph readRawPhotograph(const std::filesystem::path& path) {
  const std::string content = readFile(path);
  return rawPhotograph({content.begin(), content.end()}, path.string());
}

image::Image readRawPicture(const std::filesystem::path& path) {
  return photographOf(readRawPhotograph(path).frame, path.string());
}

}  // namespace relucent::devices
