// SPDX-License-Identifier: MIT
#pragma once

#include <QAudioDevice>
#include <QAudioOutput>
#include <QMediaDevices>
#include <QMediaPlayer>
#include <QMutex>
#include <QTimer>
#include <QVideoSink>
#include <chrono>
#include <optional>

#include "content/content_source.h"
#include "content/frame_slot.h"

namespace relucent::gui {

/// State shared by a film's source and its player across threads.
class VideoTime {
 public:
  using Clock = std::chrono::steady_clock;
  struct Asked {
    ContentTime time{0};
    Clock::time_point when{};  // the default: never yet
  };
  void ask(ContentTime time, Clock::time_point now = Clock::now());
  Asked asked() const;

 private:
  mutable QMutex guard_;
  Asked asked_;
};

/// State of the player.
struct VideoSight {
  ContentTime position{0};           // as the player reports it
  bool hasPicture = true;            // since it was opened
  std::optional<ContentTime> shown;  // time of the newest picture, if known
};

/// The next action of the player, to follow the requested time.
struct VideoStep {
  bool play = false;
  std::optional<ContentTime> seek;
};

/// Decides on it. Called every few milliseconds with the present state; has no clock and no player of its
/// own.
class VideoPursuit {
 public:
  using Clock = VideoTime::Clock;
  explicit VideoPursuit(ContentTime length) : length_(length) {}
  /// `sight.shown` is used while the time stands still.
  VideoStep next(const VideoTime::Asked& asked, const VideoSight& sight, Clock::time_point now);

 private:
  ContentTime length_;
  ContentTime last_{-1};
  Clock::time_point moved_{},
      sought_{};   // time of the last progress of the requested time; time of the last seek
  int again_ = 0;  // repeated seeks
  // Qt's player may be paused before its decoder waits, and then never shows a first picture: a jump wakes
  // it.
  std::chrono::seconds firstPicture_{2};
};

/// Qt's player, controlled to follow the time. Lives on a thread with an event loop.
class VideoFollower : public QObject {
  Q_OBJECT

 public:
  /// `frames` and `time` must outlive it. Failures are reported through `frames`.
  VideoFollower(const QString& file, FrameSlot& frames, VideoTime& time);
  ContentTime length() const { return std::chrono::milliseconds(player_.duration()); }

 private:
  void statusChanged(QMediaPlayer::MediaStatus status);
  void follow();
  void chooseSound();

  FrameSlot& frames_;
  VideoTime& time_;
  std::optional<VideoPursuit> pursuit_;
  QMediaDevices devices_;
  QVideoSink sink_;
  QAudioOutput sound_;
  QMediaPlayer player_;
  QTimer tick_;
};

}  // namespace relucent::gui
