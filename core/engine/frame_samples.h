// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

#include "relucent/engine/content_frame.h"
#include "relucent/engine/engine_plan.h"

namespace relucent::engine {

/// Colours of a few thousand camera pixels of a frame, without its warp: those of the content's pixels at
/// their centres, in the venue's colour mixing.
class FrameSamples {
 public:
  /// On a regular grid of the pixels inside that have weight.
  FrameSamples(const EngineVenue& engine, const EngineContent& content);

  const std::vector<std::size_t>& cameraPixels() const { return pixel_; }
  /// Takes a frame's colours. Allocates nothing. What is no number is black.
  /// Contract: the frame has the content's size.
  void look(const ContentFrame& frame);
  const std::vector<std::array<float, 3>>& mixed() const { return mixed_; }
  /// How much the last frame's histogram of brightness, 32 classes of its square root, differs from that of
  /// the frame before: 1/2 sum |h - h'|.
  float changed() const { return changed_; }

 private:
  static constexpr std::size_t classes = 32;

  Size size_;
  transport::ColourBlock mixing_;
  std::array<float, 256> linearOfSrgb_{};
  std::vector<std::size_t> pixel_;
  std::vector<Pixel> place_;  // of the content, at the centre of a camera pixel
  std::vector<std::array<float, 3>> mixed_;
  std::array<float, classes> histogram_{};
  float changed_ = 0.0f;
};

}  // namespace relucent::engine
