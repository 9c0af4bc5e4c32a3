// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "content/canvas.h"
#include "content/live_source.h"

namespace relucent::gui {

/// The live picture of a capture device: a camera, or a frame grabber. While it delivers nothing its last
/// picture stays.
class LiveCamera : public LiveSource {
 public:
  /// `which`: the device's name, or a part of it; empty: the first one. Waits for a first picture.
  /// Throws: Error{device} with the available devices if there is no such one, or if it delivers no picture;
  /// as pictureOf().
  LiveCamera(const QString& which, const Canvas& canvas);
  ~LiveCamera() override;

 protected:
  ContentPicture newest() override;

 private:
  struct Session;
  Canvas canvas_;
  std::unique_ptr<Session> session_;
  ContentPicture picture_;
};

}  // namespace relucent::gui
