// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "content/canvas.h"
#include "content/content_source.h"
#include "content/frame_slot.h"

namespace relucent::gui {

/// A film with its sound. It follows the requested time: picture and sound pause while that stands still,
/// seek when it jumps, and stop when there are no requests. While it plays, both run with the sound's clock,
/// and are corrected when that is off by more than a seventh of a second.
class Video : public ContentSource {
 public:
  /// Waits for the first picture.
  /// Throws: Error{disk} if the file is unreadable; Error{format} if it holds no decodable film; as
  /// pictureOf().
  Video(const QString& file, const Canvas& canvas);
  ~Video() override;

  ContentPicture at(ContentTime time) override;
  std::optional<ContentTime> length() const override { return length_; }

 private:
  struct Playback;
  void show(const FrameSlot::Newest& newest);

  Canvas canvas_;
  std::unique_ptr<Playback> playback_;
  ContentTime length_{0};
  ContentPicture picture_;  // of the frame of the same number
};

/// Extensions of films: "mp4".
const QStringList& filmEndings();
/// Whether a file's name has one of them.
bool isVideo(const QString& file);

}  // namespace relucent::gui
