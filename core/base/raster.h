// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace relucent {

/// Width and height of a raster in pixels.
struct Size {
  int width = 0;
  int height = 0;

  std::size_t count() const { return static_cast<std::size_t>(width) * static_cast<std::size_t>(height); }
  bool empty() const { return width <= 0 || height <= 0; }
  bool operator==(const Size&) const = default;
};

/// A pixel's position in its raster; index = y * width + x everywhere.
struct Pixel {
  int x = 0;
  int y = 0;
  bool operator==(const Pixel&) const = default;
};

inline std::size_t indexOf(Size size, Pixel pixel) {
  return static_cast<std::size_t>(pixel.y) * static_cast<std::size_t>(size.width) +
         static_cast<std::size_t>(pixel.x);
}
inline Pixel pixelAt(Size size, std::size_t index) {
  return {static_cast<int>(index % static_cast<std::size_t>(size.width)),
          static_cast<int>(index / static_cast<std::size_t>(size.width))};
}

/// The rasters of several devices of one kind, numbered consecutively: device d's pixels start at offset(d).
/// The rows of T are the pixels of all cameras in this order, the columns those of all projectors (paper,
/// appendix).
class Rasters {
 public:
  Rasters() = default;
  Rasters(std::vector<Size> sizes);  // NOLINT(google-explicit-constructor): a list of sizes is one
  Rasters(Size single);              // NOLINT(google-explicit-constructor)

  std::size_t devices() const { return sizes_.size(); }
  Size size(std::size_t device) const { return sizes_.at(device); }
  const std::vector<Size>& sizes() const { return sizes_; }
  std::size_t offset(std::size_t device) const { return offsets_.at(device); }
  /// Pixels of all devices together.
  std::size_t count() const { return offsets_.empty() ? 0 : offsets_.back(); }
  bool operator==(const Rasters&) const = default;

 private:
  std::vector<Size> sizes_;
  std::vector<std::size_t> offsets_;  // one element more than sizes
};

/// A std::vector that belongs to something and says to what: T can be applied to the pixels of projectors,
/// not to those of cameras. No other cost: what is done to values of any kind takes the plain vector.
template <typename Value, typename Owner>
class ValuesOf : public std::vector<Value> {
 public:
  using std::vector<Value>::vector;
  ValuesOf() = default;
  explicit ValuesOf(std::vector<Value> values) : std::vector<Value>(std::move(values)) {}
  template <typename Other>
  ValuesOf(const ValuesOf<Value, Other>&) = delete;  // of somebody else
};
struct CameraPixels;
struct ProjectorPixels;

/// Values of all pixels of a Rasters, three channels interleaved: value(pixel, c) = stack[3 * pixel + c]. Of
/// any devices: for what treats all alike, such as files.
using Stack = std::vector<float>;
/// Of all cameras' pixels: radiance, or what of it is wanted or expected.
using CameraStack = ValuesOf<float, CameraPixels>;
/// Of all projectors' pixels: linear drive, 0 to 1, or a step of it.
using ProjectorStack = ValuesOf<float, ProjectorPixels>;
/// One value a pixel, 0 or 1.
using CameraMask = ValuesOf<std::uint8_t, CameraPixels>;
using ProjectorMask = ValuesOf<std::uint8_t, ProjectorPixels>;

}  // namespace relucent
