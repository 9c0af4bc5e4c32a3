// SPDX-License-Identifier: MIT
#pragma once

#include "content/content_source.h"
#include "content/read_ahead.h"

namespace relucent::gui {

/// Numbered pictures of a film, at a fixed rate. In place of an unreadable picture the previous one stays.
class ImageSequence : public ContentSource {
 public:
  /// Throws: Error{input} if there are no files or the rate is not above 0 and at most 240.
  ImageSequence(const QStringList& files, double picturesPerSecond, const Canvas& canvas);

  ContentPicture at(ContentTime time) override;
  std::optional<ContentTime> length() const override;

 private:
  ReadAhead files_;
  double picturesPerSecond_;
  qsizetype index_ = -1;
  ContentPicture frame_;
};

/// Extensions of pictures: "png".
const QStringList& pictureEndings();
/// The pictures of a folder in the natural order of their names: 9 before 10.
/// Throws: Error{input} if it holds none.
QStringList picturesIn(const QString& folder);

}  // namespace relucent::gui
