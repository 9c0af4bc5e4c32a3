// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

#include "relucent/base/enum_names.h"
#include "relucent/base/raster.h"
#include "relucent/image/image.h"
#include "relucent/pipeline/written_files.h"

namespace relucent::pipeline {

/// The value that a picture for people shows as white: all but the brightest half percent stay below it.
float displayWhite(const image::Image& linear);

/// "pattern.exr" for the only or first device, "pattern-2.exr" for the second.
std::filesystem::path numbered(const std::filesystem::path& path, std::size_t device);

/// How a result is written as a picture: as its name ends.
enum class PictureFormat {
  exr,  // linear values with their units
  png   // to look at
};
inline constexpr EnumName<PictureFormat> pictureFormatNames[]{{PictureFormat::exr, ".exr", "linear values"},
                                                              {PictureFormat::png, ".png", "to look at"}};
constexpr EnumNames<PictureFormat> namesOf(PictureFormat) {
  return {"format of pictures", pictureFormatNames};
}
/// Throws: Error{input} unless the name ends in .exr or .png.
PictureFormat pictureFormatOf(const std::filesystem::path& path);

/// Linear values as .exr with their units; as .png what somebody sees who is used to `white`.
/// Throws: as pictureFormatOf(); Error{disk}.
void writePicture(const std::filesystem::path& path, const image::Image& linear, const std::string& units,
                  float white);

/// One picture per device, white as displayWhite() says for each.
WrittenFiles writePictures(const std::filesystem::path& out, const Stack& stack, const Rasters& rasters,
                           const std::string& units);

}  // namespace relucent::pipeline
