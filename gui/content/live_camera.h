// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "content/canvas.h"
#include "content/content_source.h"

namespace relucent {

/// The live picture of a capture device: a camera, or a box that takes the picture of another computer. While
/// it gives none its last picture stays.
class LiveCamera : public ContentSource {
 public:
  /// `which`: what the device calls itself, or a part of it; empty: the first one. Waits for a first picture.
  /// Throws: Error{device} naming the devices that are there if there is no such one, or if it gives no
  /// picture; as pictureOf().
  LiveCamera(const QString& which, const Canvas& canvas);
  ~LiveCamera() override;

  ContentPicture at(ContentTime) override;
  std::optional<ContentTime> length() const override { return std::nullopt; }

 private:
  struct Session;
  Canvas canvas_;
  std::unique_ptr<Session> session_;
  ContentPicture picture_;
};

}  // namespace relucent
