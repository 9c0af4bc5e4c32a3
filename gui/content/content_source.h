// SPDX-License-Identifier: MIT
#pragma once

#include <QImage>
#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

#include "content/live_state.h"

namespace relucent::gui {

/// Content time: shared by all projectors, stops while the show is paused.
using ContentTime = std::chrono::microseconds;

/// Whether somebody is there, while content plays, who could answer a question.
enum class Attendance { attended, unattended };

/// A picture of content.
struct ContentPicture {
  QImage image;              // upright, opaque; sRGB in Format_RGBX8888, or linear in Format_RGBX32FPx4
  std::uint64_t number = 0;  // differs between different pictures
  /// Of a still picture from a file, see compensation::contentIdentity(); empty: of anything else.
  std::string identity{};
  /// Of a live picture: when it was there, at this computer.
  std::optional<std::chrono::steady_clock::time_point> arrived{};
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
  /// Whether it has what it was opened for; until then at() gives black. From any thread.
  virtual bool isReady() const { return true; }
  /// Of what may be lost and come back; none: of anything else. From any thread.
  virtual std::optional<LiveState> live() const { return std::nullopt; }
};

}  // namespace relucent::gui
