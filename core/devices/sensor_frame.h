// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "relucent/image/image.h"

namespace relucent::devices {

/// How colours lie on a sensor: the colours of the first two pixels of the first row, or of every pixel.
enum class SensorLayout { mono, bayerRG, bayerGR, bayerGB, bayerBG, rgb, bgr };

/// How a camera delivers its pixels: unpacked, one byte a sample up to 8 bits, else two, little endian.
struct SensorFormat {
  SensorLayout layout = SensorLayout::mono;
  int bits = 8;
  bool operator==(const SensorFormat&) const = default;
};

/// "Mono12", "BayerRG8", "RGB8": the names of GenICam's pixel format naming convention. None for formats
/// that are not read: packed ones, those of more than 16 bits, and everything with brightness apart from
/// colour.
std::optional<SensorFormat> sensorFormatFromName(std::string_view name);
std::string nameOf(const SensorFormat& format);
/// Of the formats that a camera has, the one that loses least: colour before grey, a sensor's own values
/// before those that the camera has interpolated, more bits before fewer.
std::optional<SensorFormat> bestFormat(const std::vector<std::string>& names);

/// What the codes of raw files mean: signal = (code - black) / (white - black).
struct SensorLevels {
  std::array<float, 4> black{};  // of the pixels of a 2x2 cell, row by row
  float white = 0.0f;            // the code of a full sensor
};

/// Rows as a camera delivered them, without padding.
struct SensorFrame {
  Size size;  // in sensor pixels
  SensorFormat format;
  std::vector<std::uint8_t> bytes;
  std::optional<SensorLevels> levels{};  // none: codes run from 0 to full scale
};

/// The size of the photograph that comes of a frame: half of it both ways where a colour filter lies on the
/// sensor.
Size photographSize(Size sensor, const SensorFormat& format);
/// The other way round.
Size sensorSize(Size photograph, const SensorFormat& format);
/// Bits of the photograph's samples, as RawFrame::bits: one more than the sensor's under a colour filter.
int photographBits(const SensorFormat& format);
/// The same for a frame: 0, floating point, if it has levels.
int photographBits(const SensorFrame& frame);

/// The photograph in a frame: linear, three channels, full scale 1.
/// Under a colour filter each 2x2 cell of the sensor is one pixel: red, blue, and the sum of both greens.
///   signal = {2 R, G1 + G2, 2 B} / (2^(bits + 1) - 1)
/// Each value is a fixed weighted sum of that pixel's own sensor values, so light that adds up on the sensor
/// adds up in the photograph, noise stays independent between pixels, and no light moves into a neighbour.
/// Interpolation along edges (variable gradients, edge-aware) is not linear; bilinear interpolation is, but
/// widens every footprint of T by a pixel and invents three quarters of the unknown samples.
/// With levels, black is taken from every code first and white is full scale. What noise carries below black
/// stays negative: cut off at zero, dark places would be too bright on average.
/// A grey camera's value stands in all three channels.  Source: core/devices/README.md.
/// Throws: Error{device} if there are fewer bytes than pixels.
image::Image photographOf(const SensorFrame& frame, const std::string& camera);

}  // namespace relucent::devices
