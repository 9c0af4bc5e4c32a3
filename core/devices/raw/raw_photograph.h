// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <ctime>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "relucent/devices/sensor_frame.h"

namespace relucent::devices {

/// A photograph out of a raw file: the sensor's own values, and what the camera wrote down beside them.
struct RawPhotograph {
  SensorFrame frame;                   // with levels: nothing is balanced, curved, brightened or interpolated
  std::string model;                   // "Canon EOS 80D"
  double seconds = 0.0;                // exposure time as written in the file; 0: none is
  std::optional<std::time_t> taken{};  // by the camera's clock, whole seconds
};

/// Whether this build reads raw files: it was made with LibRaw.
bool hasRawPhotographs();

/// Whether a file's name is that of a raw file: ".CR2", ".nef", ".dng", ...
bool isRawName(const std::filesystem::path& path);

/// Reads the raw file in `bytes`: every format that LibRaw knows, from sensors with a Bayer filter or none.
/// The frame is the visible part of the sensor, cut to whole 2x2 cells.
/// Throws: Error{format} within `name` if it is damaged or no raw file, if its values are not the sensor's
/// own (sRAW, mRAW, linear DNG) or the filter is another (X-Trans, Foveon); in a build without LibRaw.
RawPhotograph rawPhotograph(const std::vector<std::uint8_t>& bytes, const std::string& name);

/// The same from a file. Throws: also Error{disk} if it cannot be read.
RawPhotograph readRawPhotograph(const std::filesystem::path& path);

/// When the photograph in a raw file was taken, by its camera's clock; reads little of the file. None if it
/// does not say, or cannot be read.
std::optional<std::time_t> timeTaken(const std::filesystem::path& rawFile);

/// The photograph in a raw file, for measuring: linear, three channels, half the sensor's size both ways,
/// black 0, a full sensor 1. Throws: as readRawPhotograph().
image::Image readRawPicture(const std::filesystem::path& path);

}  // namespace relucent::devices
