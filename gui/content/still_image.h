// SPDX-License-Identifier: MIT
#pragma once

#include "content/canvas.h"
#include "content/content_source.h"

namespace relucent {

/// A picture that stands still.
class StillImage : public ContentSource {
 public:
  /// Throws: as readContent().
  StillImage(const QString& file, const Canvas& canvas);
  /// A picture that is there already.
  StillImage(const QImage& picture, const Canvas& canvas);

  ContentPicture at(ContentTime) override { return frame_; }
  std::optional<ContentTime> length() const override { return std::nullopt; }

 private:
  ContentPicture frame_;
};

/// A number that no other frame of this run has.
std::uint64_t nextFrameNumber();

}  // namespace relucent
