// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "relucent/base/enum_names.h"
#include "relucent/image/image.h"
#include "relucent/pipeline/standard_images.h"

namespace relucent::pipeline {

/// What plays while a venue is watched.
enum class ShownContent { still, film, dark, slides };
inline constexpr EnumName<ShownContent> shownContentNames[]{
    {ShownContent::still, "still", "one picture all the time"},
    {ShownContent::film, "film", "scenes that pan, cut and fade, 25 frames a second"},
    {ShownContent::dark, "dark", "a film of night scenes"},
    {ShownContent::slides, "slides", "pictures that take each other's place every 8 seconds"}};
constexpr EnumNames<ShownContent> namesOf(ShownContent) {
  return {"content", shownContentNames};
}

/// Shows that are rehearsed, frame by frame.
class RehearsedContent {
 public:
  static constexpr Size canvas{240, 180};
  static constexpr double framesPerSecond = 25.0;

  explicit RehearsedContent(std::uint64_t seed) : seed_(seed), images_(judgedImages(canvas)) {}

  /// Frames that are alike have one key.
  std::int64_t keyOf(ShownContent content, std::int64_t frame) const;
  /// Linear light, of the canvas's size.
  image::Image at(ShownContent content, std::int64_t key) const;
  /// Other scenes.
  void setSeed(std::uint64_t seed) { seed_ = seed; }

 private:
  std::uint64_t seed_;
  std::vector<NamedImage> images_;
};

}  // namespace relucent::pipeline
