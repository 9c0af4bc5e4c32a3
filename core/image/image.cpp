// SPDX-License-Identifier: MIT
#include "relucent/image/image.h"

#include <algorithm>

#include "relucent/base/error.h"

namespace relucent::image {

Image::Image(Size size, int channels, float fill)
    : size_(size), channels_(channels), data_(size.count() * static_cast<std::size_t>(channels), fill) {
  require(size.width >= 0 && size.height >= 0 && channels > 0, "no image of {}x{} pixels, {} channels",
          size.width, size.height, channels);
}

Image::Image(Size size, int channels, std::vector<float> samples)
    : size_(size), channels_(channels), data_(std::move(samples)) {
  require(channels > 0 && data_.size() == size.count() * static_cast<std::size_t>(channels),
          "{} samples do not fill {}x{} pixels of {} channels", data_.size(), size.width, size.height,
          channels);
}

Image imageFromStack(const Stack& stack, const Rasters& rasters, std::size_t device) {
  require(stack.size() == rasters.count() * 3, "a stack of {} values does not belong to {} pixels",
          stack.size(), rasters.count());
  auto begin = stack.begin() + static_cast<std::ptrdiff_t>(rasters.offset(device) * 3);
  auto end = begin + static_cast<std::ptrdiff_t>(rasters.size(device).count() * 3);
  return Image(rasters.size(device), 3, std::vector<float>(begin, end));
}

Stack stackFromImages(std::span<const Image> images, const Rasters& rasters) {
  require(images.size() == rasters.devices(), "{} images for {} devices", images.size(), rasters.devices());
  Stack stack;
  stack.reserve(rasters.count() * 3);
  for (std::size_t device = 0; device < images.size(); ++device) {
    const Image& image = images[device];
    require(image.size() == rasters.size(device) && image.channels() == 3,
            "image {} is {}x{} of {} channels, not {}x{} of 3", device, image.width(), image.height(),
            image.channels(), rasters.size(device).width, rasters.size(device).height);
    stack.insert(stack.end(), image.data().begin(), image.data().end());
  }
  return stack;
}

}  // namespace relucent::image
