// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "content/canvas.h"
#include "content/live_source.h"

namespace relucent::gui {

/// The live picture of one of the desktop's screens, or of a window, through the X server, where there is no
/// Wayland: its present contents, without the pointer. Covered parts of a window are missing. While the
/// screen or window does not exist its last picture stays.
class LiveScreen : public LiveSource {
 public:
  enum class What {
    screen,  // by its connector: HDMI-1
    window,  // by its number, as in xwininfo, or a part of its title
  };
  /// Throws: Error{device} if there is no X server, Error{input} with the available screens or windows if
  /// there is no such one.
  LiveScreen(What what, const QString& which, const Canvas& canvas);
  ~LiveScreen() override;

 protected:
  ContentPicture newest() override;

 private:
  class Grabber;
  std::unique_ptr<Grabber> grabber_;
  Canvas canvas_;
  QImage grabbed_;
  ContentPicture picture_;
};

}  // namespace relucent::gui
