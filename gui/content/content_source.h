// SPDX-License-Identifier: MIT
#pragma once

#include <QImage>
#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

namespace relucent::gui {

/// Content time: shared by all projectors, stops while the show is paused.
using ContentTime = std::chrono::microseconds;

/// A picture of content.
struct ContentPicture {
  QImage image;              // upright, opaque; sRGB in Format_RGBX8888, or linear in Format_RGBX32FPx4
  std::uint64_t number = 0;  // differs between different pictures
  /// Of a still picture from a file, see compensation::contentIdentity(); empty: of anything else.
  std::string identity{};
};

/// Something that can be played. All frames have the size of the canvas, whatever the files hold, so that
/// preparations for a size remain valid. Used from one thread, with times in any order; must return within a
/// frame's time, so slow sources read ahead.
class ContentSource {
 public:
  virtual ~ContentSource() = default;
  /// The picture at `time` from the beginning of the source; after its end the last one.
  virtual ContentPicture at(ContentTime time) = 0;
  /// None: a still picture without a duration of its own.
  virtual std::optional<ContentTime> length() const = 0;
};

}  // namespace relucent::gui
