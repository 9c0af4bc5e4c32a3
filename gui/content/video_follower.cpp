// SPDX-License-Identifier: MIT
#include "content/video_follower.h"

#include <QMediaFormat>
#include <QMediaMetaData>
#include <QMutexLocker>
#include <QUrl>
#include <algorithm>

namespace relucent::gui {
namespace {

using namespace std::chrono_literals;

constexpr int interval = 15;            // milliseconds between two looks at the time
constexpr auto forgotten = 400ms;       // since it was asked for: nobody shows it any more
constexpr auto standsStill = 150ms;     // since the time asked for moved: longer than a slow frame takes
constexpr ContentTime astray{140'000};  // that nobody hears or sees
// It plays on until the standing is noticed; to jump back by that would be seen.
constexpr ContentTime astrayStanding{220'000};
constexpr ContentTime lastPicture{40'000};
constexpr int mostAgain = 3;
constexpr auto betweenJumps = 500ms;  // what a jump takes until it shows in the position

}  // namespace

void VideoTime::ask(ContentTime time, Clock::time_point now) {
  QMutexLocker lock(&guard_);
  asked_ = {time, now};
}

VideoTime::Asked VideoTime::asked() const {
  QMutexLocker lock(&guard_);
  return asked_;
}

VideoStep VideoPursuit::next(const VideoTime::Asked& asked, const VideoSight& sight, Clock::time_point now) {
  const auto& [position, hasPicture, shown] = sight;
  if (!hasPicture) {
    if (sought_ == Clock::time_point{}) sought_ = now;
    if (now - sought_ < firstPicture_) return {};
    sought_ = now;
    firstPicture_ *= 2;  // a slow disk is not to begin anew for ever
    return {false, ContentTime{0}};
  }
  if (asked.when == Clock::time_point{} || now - asked.when > forgotten) {
    last_ = ContentTime{-1};
    return {};
  }
  bool jumped = last_ < ContentTime{0} || asked.time < last_ || asked.time > last_ + 1s;
  if (jumped) again_ = 0;
  if (asked.time != last_) moved_ = now;
  last_ = asked.time;
  bool runs = now - moved_ < standsStill;
  ContentTime wanted = asked.time;
  if (runs) wanted += std::chrono::duration_cast<ContentTime>(now - asked.when);
  // Behind the end its last picture stays.
  wanted = std::min(wanted, std::max(ContentTime{0}, length_ - lastPicture));
  VideoStep step{runs && position < length_, std::nullopt};
  auto isAstray = [&](ContentTime place) {
    return std::chrono::abs(place - wanted) > (runs ? astray : astrayStanding);
  };
  // Qt's player may jump while it stands and show what it showed before.
  bool failed = !runs && shown && isAstray(*shown) && again_ < mostAgain;
  if ((isAstray(position) || failed) && (jumped || now - sought_ > betweenJumps)) {
    if (!isAstray(position) && !jumped) ++again_;
    step.seek = wanted;
    sought_ = now;
  }
  return step;
}

VideoFollower::VideoFollower(const QString& file, FrameSlot& frames, VideoTime& time)
    : frames_(frames), time_(time) {
  // Without a context: called by the decoder's thread, which nobody here waits for.
  connect(&sink_, &QVideoSink::videoFrameChanged,
          [slot = &frames](const QVideoFrame& frame) { slot->put(frame); });
  connect(&player_, &QMediaPlayer::errorOccurred, this,
          [this](QMediaPlayer::Error, const QString& reason) { frames_.fail(reason); });
  connect(&player_, &QMediaPlayer::mediaStatusChanged, this, &VideoFollower::statusChanged);
  connect(&tick_, &QTimer::timeout, this, &VideoFollower::follow);
  player_.setVideoSink(&sink_);
  connect(&devices_, &QMediaDevices::audioOutputsChanged, this, &VideoFollower::chooseSound);
  chooseSound();
  player_.setSource(QUrl::fromLocalFile(file));
}

void VideoFollower::chooseSound() {
  // Qt 6.4 crashes when it has sound to play and no device to play it on.
  bool mute = QMediaDevices::audioOutputs().isEmpty();
  if (!mute) sound_.setDevice(QMediaDevices::defaultAudioOutput());
  player_.setAudioOutput(mute ? nullptr : &sound_);
}

void VideoFollower::statusChanged(QMediaPlayer::MediaStatus status) {
  if (status == QMediaPlayer::InvalidMedia) {
    frames_.fail(player_.errorString());
  } else if (status == QMediaPlayer::LoadedMedia && !pursuit_) {
    if (!player_.hasVideo()) return frames_.fail("it holds no picture");
    if (player_.duration() <= 0) return frames_.fail("it tells no length");
    if (player_.metaData().value(QMediaMetaData::VideoCodec).value<QMediaFormat::VideoCodec>() ==
        QMediaFormat::VideoCodec::MotionJPEG)
      frames_.markAsJpeg();
    pursuit_.emplace(length());
    player_.pause();  // shows the first picture
    tick_.start(interval);
  }
}

void VideoFollower::follow() {
  const FrameSlot::Newest newest = frames_.newest();
  VideoSight sight{std::chrono::milliseconds(player_.position()), newest.number != 0, std::nullopt};
  if (qint64 start = newest.frame.startTime(); start >= 0) sight.shown = ContentTime(start);
  VideoStep step = pursuit_->next(time_.asked(), sight, VideoTime::Clock::now());
  bool stopped = player_.playbackState() == QMediaPlayer::StoppedState;
  if (step.seek) {
    // Behind its end a player has stopped, and would begin again by itself.
    if (stopped) player_.pause();
    player_.setPosition(std::chrono::duration_cast<std::chrono::milliseconds>(*step.seek).count());
  }
  bool plays = player_.playbackState() == QMediaPlayer::PlayingState;
  if (step.play && !plays && (!stopped || step.seek)) player_.play();
  if (!step.play && plays) player_.pause();
}

}  // namespace relucent::gui
