// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "relucent/base/large_vector.h"
#include "relucent/image/image.h"

namespace relucent::importing {

/// Many pictures of one size, held so that what one pixel showed in all of them lies side by side: its
/// sequence. 16 bits a value on a scale of each picture's own (its largest value, at least 1), so a step is
/// at most 1.6e-5 of that. Grey pictures, three equal channels, take a third of the memory until a coloured
/// one comes. Values below zero become zero.
class PictureSequence {
 public:
  PictureSequence() = default;
  PictureSequence(Size size, int pictures);

  /// Contract: three channels, this size, only finite values.
  void set(int picture, const image::Image& image);

  Size size() const { return size_; }
  int pictures() const { return pictures_; }
  bool isColoured() const { return channels_ == 3; }
  bool isColoured(int picture) const { return coloured_[static_cast<std::size_t>(picture)] != 0; }
  float value(std::size_t pixel, int picture, int channel) const {
    return scale_[static_cast<std::size_t>(picture)] * static_cast<float>(code(pixel, picture, channel));
  }
  /// The stored code: value / 65535 for pictures whose values stay within 1.
  std::uint16_t code(std::size_t pixel, int picture, int channel) const {
    auto channels = static_cast<std::size_t>(channels_);
    return codes_[(pixel * static_cast<std::size_t>(pictures_) + static_cast<std::size_t>(picture)) *
                      channels +
                  (channels_ == 3 ? static_cast<std::size_t>(channel) : 0)];
  }
  /// The mean of a pixel's channels.
  float grey(std::size_t pixel, int picture) const;
  /// One picture of three channels.
  image::Image picture(int picture) const;

 private:
  void widen();

  Size size_;
  int pictures_ = 0;
  int channels_ = 1;
  std::vector<float> scale_;
  std::vector<std::uint8_t> coloured_;
  LargeVector<std::uint16_t> codes_;  // [pixel][picture][channel]
};

}  // namespace relucent::importing
