// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "relucent/base/raster.h"

namespace relucent::image {

/// A float image, channels interleaved: sample(x, y, c) = data[(y * width + x) * channels + c].
/// Linear light unless the name of the variable says otherwise (`encoded...`).
class Image {
 public:
  Image() = default;
  Image(Size size, int channels, float fill = 0.0f);
  /// Throws: std::logic_error unless samples.size() == size.count() * channels.
  Image(Size size, int channels, std::vector<float> samples);

  Size size() const { return size_; }
  int width() const { return size_.width; }
  int height() const { return size_.height; }
  int channels() const { return channels_; }
  bool empty() const { return data_.empty(); }
  std::size_t pixels() const { return size_.count(); }

  float& at(int x, int y, int c) { return data_[offset(x, y, c)]; }
  float at(int x, int y, int c) const { return data_[offset(x, y, c)]; }
  std::span<float> pixel(std::size_t index) {
    return {data_.data() + index * static_cast<std::size_t>(channels_), static_cast<std::size_t>(channels_)};
  }
  std::span<const float> pixel(std::size_t index) const {
    return {data_.data() + index * static_cast<std::size_t>(channels_), static_cast<std::size_t>(channels_)};
  }
  std::vector<float>& data() { return data_; }
  const std::vector<float>& data() const { return data_; }

  bool operator==(const Image&) const = default;

 private:
  std::size_t offset(int x, int y, int c) const {
    return (static_cast<std::size_t>(y) * static_cast<std::size_t>(size_.width) +
            static_cast<std::size_t>(x)) *
               static_cast<std::size_t>(channels_) +
           static_cast<std::size_t>(c);
  }

  Size size_;
  int channels_ = 0;
  std::vector<float> data_;
};

/// Device `device`'s part of a stack as an image of three channels, and back.
Image imageFromStack(const Stack& stack, const Rasters& rasters, std::size_t device);
Stack stackFromImages(std::span<const Image> images, const Rasters& rasters);

}  // namespace relucent::image
