// SPDX-License-Identifier: MIT
#include "relucent/pipeline/pictures.h"

#include <fmt/format.h>

#include <algorithm>

#include "relucent/base/error.h"
#include "relucent/image/colour.h"
#include "relucent/image/exr.h"
#include "relucent/image/picture_files.h"

namespace relucent::pipeline {
namespace fs = std::filesystem;

float displayWhite(const image::Image& linear) {
  std::vector<float> values = linear.data();
  if (values.empty()) return 1.0f;
  auto place = values.begin() + static_cast<std::ptrdiff_t>(values.size() * 995 / 1000);
  std::nth_element(values.begin(), place, values.end());
  return std::max(*place, 1e-9f);
}

fs::path numbered(const fs::path& path, std::size_t device) {
  if (device == 0) return path;
  fs::path result = path;
  return result.replace_filename(
      fmt::format("{}-{}{}", path.stem().string(), device + 1, path.extension().string()));
}

PictureFormat pictureFormatOf(const fs::path& path) {
  std::string extension = path.extension().string();
  if (std::optional<PictureFormat> format = valueNamed<PictureFormat>(extension)) return *format;
  throw Error(
      ErrorKind::input,
      RELUCENT_ENGLISH_MESSAGE("image.output-format-unsupported", "pictures are not written as \"{}\"")
          .with(extension),
      RELUCENT_ENGLISH_MESSAGE("image.choose-exr-or-png",
                               "choose a name that ends in .exr (linear values) or .png (to look at)"),
      path.string());
}

void writePicture(const fs::path& path, const image::Image& linear, const std::string& units, float white) {
  switch (pictureFormatOf(path)) {
    case PictureFormat::exr:
      return image::writeExr(path, linear, image::ExrType::floatType, {{image::exr_attribute::units, units}});
    case PictureFormat::png:
      return image::writePng(path, image::viewed(linear, {white, white, white}), 8);
  }
}

WrittenFiles writePictures(const fs::path& out, const Stack& stack, const Rasters& rasters,
                           const std::string& units) {
  WrittenFiles written;
  for (std::size_t device = 0; device < rasters.devices(); ++device) {
    image::Image picture = image::imageFromStack(stack, rasters, device);
    written.files.push_back(numbered(out, device));
    writePicture(written.files.back(), picture, units, displayWhite(picture));
  }
  return written;
}

}  // namespace relucent::pipeline
