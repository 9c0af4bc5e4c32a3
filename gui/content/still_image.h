// SPDX-License-Identifier: MIT
#pragma once

#include "content/canvas.h"
#include "content/content_source.h"

namespace relucent::gui {

/// A still picture.
class StillImage : public ContentSource {
 public:
  /// Throws: as readContent().
  StillImage(const QString& file, const Canvas& canvas);
  /// From a picture in memory.
  StillImage(const QImage& picture, const Canvas& canvas);

  ContentPicture at(ContentTime) override { return frame_; }
  std::optional<ContentTime> length() const override { return std::nullopt; }

 private:
  ContentPicture frame_;
};

/// A number that is unique within this process.
std::uint64_t nextFrameNumber();

}  // namespace relucent::gui
