// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "content/canvas.h"
#include "content/content_source.h"

namespace relucent {

/// The live picture of one of the desktop's screens, or of a window, through the X server: what stands there
/// when it is asked for, without the pointer. Of a window, what others cover is missing. While the screen or
/// the window is away its last picture stays.
class LiveScreen : public ContentSource {
 public:
  enum class What {
    screen,  // by its connector: HDMI-1
    window,  // by its number, as xwininfo tells it, or a part of its title
  };
  /// Throws: Error{device} if there is no X server, Error{input} naming the screens or windows that are there
  /// if there is no such one.
  LiveScreen(What what, const QString& which, const Canvas& canvas);
  ~LiveScreen() override;

  ContentPicture at(ContentTime) override;
  std::optional<ContentTime> length() const override { return std::nullopt; }

 private:
  class Grabber;
  std::unique_ptr<Grabber> grabber_;
  Canvas canvas_;
  QImage grabbed_;
  ContentPicture picture_;
};

}  // namespace relucent
