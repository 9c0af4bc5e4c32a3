// SPDX-License-Identifier: MIT
#include "relucent/importing/picture_sequence.h"

#include <algorithm>
#include <cmath>

#include "relucent/base/error.h"
#include "relucent/base/parallel.h"

namespace relucent::importing {
namespace {

constexpr float fullCode = 65535.0f;

bool isGrey(const image::Image& image) {
  const std::vector<float>& data = image.data();
  for (std::size_t i = 0; i < data.size(); i += 3)
    if (data[i] != data[i + 1] || data[i] != data[i + 2]) return false;
  return true;
}

}  // namespace

PictureSequence::PictureSequence(Size size, int pictures)
    : size_(size),
      pictures_(pictures),
      scale_(static_cast<std::size_t>(pictures), 1.0f / fullCode),
      coloured_(static_cast<std::size_t>(pictures)),
      codes_(size.count() * static_cast<std::size_t>(pictures)) {}

void PictureSequence::set(int picture, const image::Image& image) {
  require(image.size() == size_ && image.channels() == 3, "a picture of {}x{} pixels among {}x{}",
          image.width(), image.height(), size_.width, size_.height);
  require(picture >= 0 && picture < pictures_, "no picture {} of {}", picture, pictures_);
  auto index = static_cast<std::size_t>(picture);
  coloured_[index] = isGrey(image) ? 0 : 1;
  if (coloured_[index] != 0 && channels_ == 1) widen();

  float largest = image.empty() ? 1.0f : *std::max_element(image.data().begin(), image.data().end());
  scale_[index] = std::max(1.0f, largest) / fullCode;
  auto channels = static_cast<std::size_t>(channels_);
  auto stride = static_cast<std::size_t>(pictures_) * channels;
  parallelFor(0, image.pixels(), 4096, [&](std::size_t pixel) {
    for (std::size_t c = 0; c < channels; ++c) {
      float code = image.data()[3 * pixel + c] / scale_[index];
      codes_[pixel * stride + index * channels + c] =
          static_cast<std::uint16_t>(std::lround(std::clamp(code, 0.0f, fullCode)));
    }
  });
}

void PictureSequence::widen() {
  LargeVector<std::uint16_t> wide(3 * codes_.size());
  for (std::size_t i = 0; i < wide.size(); ++i) wide[i] = codes_[i / 3];
  codes_ = std::move(wide);
  channels_ = 3;
}

float PictureSequence::grey(std::size_t pixel, int picture) const {
  if (channels_ == 1) return value(pixel, picture, 0);
  return (value(pixel, picture, 0) + value(pixel, picture, 1) + value(pixel, picture, 2)) / 3.0f;
}

image::Image PictureSequence::picture(int picture) const {
  image::Image image(size_, 3);
  for (std::size_t i = 0; i < image.data().size(); ++i)
    image.data()[i] = value(i / 3, picture, static_cast<int>(i % 3));
  return image;
}

}  // namespace relucent::importing
