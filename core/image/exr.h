// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "relucent/image/image.h"

namespace relucent::image {

/// Names of the attributes that state the units and the origin of our files.
namespace exr_attribute {
inline constexpr const char* units = "relucent:units";              // "camera signal per second"
inline constexpr const char* software = "relucent:software";        // "Relucent 0.1.0"
inline constexpr const char* fingerprint = "relucent:fingerprint";  // of the inputs
inline constexpr const char* checksum = "relucent:checksum";        // of the pixels, where nothing is packed
}  // namespace exr_attribute

using ExrAttribute = std::variant<std::string, double, int>;

/// An OpenEXR picture with any channels and any data window.
struct ExrImage {
  Image pixels;                           // the data window
  std::vector<std::string> channelNames;  // of the channels of `pixels`, in their order
  Pixel dataOrigin;                       // position of the data window's first pixel
  Pixel displayOrigin;
  std::optional<Size> displaySize;  // none: the display window is the data window
  /// Text and numbers; without the attributes that OpenEXR itself requires (windows, channels, ...).
  std::map<std::string, ExrAttribute> attributes;
};

enum class ExrType { half, floatType };

/// How the lines of a file are packed, losslessly both: by ZIP, or as they are with a checksum of the pixels,
/// float only. Of what a camera measured ZIP saves a twentieth, and takes ten times as long as writing it.
enum class ExrPacking { zip, none };

/// Reads scan-line or tiled files of one part, every channel converted to float. Values are returned
/// unchanged, NaN and infinities included: see checkFinite(). Channels come in the file's alphabetical order,
/// except that R, G, B, A of a layer are in that order. Throws: Error{disk} if unreadable; Error{format} if
/// foreign, damaged (with another checksum than its pixels, too), truncated, deep, of several parts or with
/// subsampled channels.
ExrImage readExr(const std::filesystem::path& path);

/// Writes atomically, in scan lines. Float is exact; half rounds to nearest.
/// Throws: Error{input} if a finite value is too large for half; Error{disk}. std::logic_error if names and
/// channels do not match or an attribute has a name that OpenEXR reserves.
void writeExr(const std::filesystem::path& path, const ExrImage& image, ExrType type,
              ExrPacking packing = ExrPacking::zip);

/// An image of three channels as R, G, B (or of one as Y), display window = data window.
void writeExr(const std::filesystem::path& path, const Image& image, ExrType type,
              std::map<std::string, ExrAttribute> attributes = {}, ExrPacking packing = ExrPacking::zip);

/// R, G, B on the raster of the display window; 0 outside the data window. A file with Y alone is grey.
/// Throws: as readExr(); Error{format} naming the existing channels if R, G, B are missing;
/// Error{input} if the display window does not have the `expected` size.
Image readRgbExr(const std::filesystem::path& path, std::optional<Size> expected = std::nullopt);

/// True if `content` starts like an OpenEXR file.
bool looksLikeExr(std::string_view content);

/// Throws: Error{input} with the number of NaN and infinite values and the position of the first, if any.
void checkFinite(const Image& image, const std::filesystem::path& path);

}  // namespace relucent::image
