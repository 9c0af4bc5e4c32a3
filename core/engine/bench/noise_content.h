// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "relucent/engine/content_frame.h"

namespace relucent::engine {

/// Content of no meaning, all of whose bytes differ.
class NoiseContent {
 public:
  explicit NoiseContent(Size size) : pixels_(4 * size.count()), size_(size) {
    for (std::size_t i = 0; i < pixels_.size(); ++i)
      pixels_[i] = static_cast<std::uint8_t>(i * 2654435761u >> 24);
  }
  ContentFrame frame() const {
    return {pixels_.data(), size_, 4 * static_cast<std::size_t>(size_.width), ContentFrame::Format::rgba8};
  }

 private:
  std::vector<std::uint8_t> pixels_;
  Size size_;
};

}  // namespace relucent::engine
