// SPDX-License-Identifier: MIT
#include "content/video.h"

#include <fmt/format.h>
#include <QFile>
#include <QFileInfo>

#include "content/media_thread.h"
#include "content/video_follower.h"
#include "content/video_frame.h"
#include "relucent/base/error.h"

namespace relucent::gui {
namespace {

constexpr int diskPatience = 15'000;  // milliseconds for a first picture, of a disk that wakes up

}  // namespace

struct Video::Playback {
  explicit Playback(const QString& file)
      : follower([&] { return std::make_unique<VideoFollower>(file, frames, time); }) {}
  FrameSlot frames;
  VideoTime time;
  OnMediaThread<VideoFollower> follower;  // uses both, goes first
};

Video::Video(const QString& file, const Canvas& canvas) : canvas_(canvas) {
  if (QFile probe(file); !probe.open(QIODevice::ReadOnly))
    throw Error(
        ErrorKind::disk,
        RELUCENT_MESSAGE("disk.cannot-read", "cannot read ({})").with(probe.errorString().toStdString()),
        RELUCENT_MESSAGE("disk.check-path-and-disk", "check the path and the disk"), file.toStdString());
  chooseMediaBackend();
  playback_ = std::make_unique<Playback>(file);
  if (!playback_->frames.waitForFirst(diskPatience)) {
    const std::string reason = playback_->frames.failure().toStdString();
    throw Error(
        ErrorKind::format,
        RELUCENT_ENGLISH_MESSAGE("content.film-not-playable", "no film that can be played ({})")
            .with(reason.empty() ? fmt::format("no picture within {} s", diskPatience / 1000) : reason),
        RELUCENT_ENGLISH_MESSAGE("content.convert-to-mp4", "convert it to H.264 in an MP4 file"),
        file.toStdString());
  }
  playback_->follower.with([this](VideoFollower& follower) { length_ = follower.length(); });
  show(playback_->frames.newest());  // what cannot be shown is refused now
}

Video::~Video() = default;

ContentPicture Video::at(ContentTime time) {
  playback_->time.ask(time);
  show(playback_->frames.newest());
  return picture_;
}

void Video::show(const FrameSlot::Newest& newest) {
  if (newest.number != picture_.number)
    picture_ = {onCanvas(pictureOf(newest.frame, newest.jpeg), canvas_), newest.number};
}

const QStringList& filmEndings() {
  static const QStringList endings{"mp4", "m4v", "mov",  "mkv", "webm", "avi", "mpg",  "mpeg",
                                   "ts",  "mts", "m2ts", "wmv", "ogv",  "mxf", "mjpeg"};
  return endings;
}

bool isVideo(const QString& file) {
  return filmEndings().contains(QFileInfo(file).suffix().toLower());
}

}  // namespace relucent::gui
