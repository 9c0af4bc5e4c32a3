// SPDX-License-Identifier: MIT
#pragma once

#include <QImage>
#include <chrono>
#include <cstdint>
#include <optional>

namespace relucent {

/// Time of the content: shared by all projectors, stands still while the show is paused.
using ContentTime = std::chrono::microseconds;

/// A picture of content.
struct ContentPicture {
  QImage image;              // upright, opaque; sRGB in Format_RGBX8888, or linear in Format_RGBX32FPx4
  std::uint64_t number = 0;  // another number, another picture
};

/// Something that can be played. All frames have the size of the canvas, whatever the files hold, so that
/// what is prepared for a size stays prepared. Asked from one thread, in any order of times; must answer
/// within a frame's time: what takes longer is read ahead.
class ContentSource {
 public:
  virtual ~ContentSource() = default;
  /// The picture at `time` after the source's beginning; the last one beyond its end.
  virtual ContentPicture at(ContentTime time) = 0;
  /// None: a picture that stands still for as long as somebody wants it.
  virtual std::optional<ContentTime> length() const = 0;
};

}  // namespace relucent
